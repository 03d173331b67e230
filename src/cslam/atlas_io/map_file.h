// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/camera_file.h"
#include "cslam/map/map.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cslam {

inline constexpr int kMapFormatVersion = 4;        // that is written
inline constexpr int kOldestMapFormatVersion = 2;  // that is read

// What a map file says about the map as a whole.
struct MapFileInfo {
  int version = kMapFormatVersion;  // of the format that was read; the newest is written
  std::string program;              // that wrote it, with its version
  std::string created;              // date and time, ISO 8601, UTC
  CameraConfig camera;              // all but its source is stored
  std::vector<double> level_scales;
  std::vector<std::string> sessions;  // names of the map's sessions, as far as they have one
};

struct SavedMap {
  MapFileInfo info;
  Map map;
};

// Writes every map of the atlas into one SQLite file (docs/formats.md). Whatever happens while it
// does, crash, kill -9 and full disk included, an older file of that name stays as it was until
// the new one is complete. Throws Error if it cannot be written. One call per path at a time.
void SaveMap(const std::filesystem::path& path, const MapView& map, const MapFileInfo& info);

// Throws Error, one line, for a file that is missing, foreign, of a version it cannot read, cut
// off or damaged. What it returns equals what was saved, and its invariants hold.
SavedMap LoadMap(const std::filesystem::path& path);

// Throws Error, saying what differs, unless the map was made with this camera: points of view and
// scales would not fit.
void RequireSameCamera(const std::filesystem::path& path, const MapFileInfo& info,
                       const Camera& camera);

}  // namespace cslam
