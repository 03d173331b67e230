// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/atlas_io/map_file.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <string>
#include <vector>

namespace cslam {

// One map of the atlas.
struct MapSummary {
  MapId map;
  std::size_t num_keyframes = 0;
  std::size_t num_points = 0;
  Stamp first, last;                  // of its keyframes
  Eigen::AlignedBox3d keyframes_box;  // around their positions, metres
  Eigen::AlignedBox3d points_box;     // around its points; empty if there are none
};

// Of every map with a keyframe, by id.
std::vector<MapSummary> SummariseMaps(const MapView& map);

// The map with the most keyframes (of equals the first). Throws Error if there is none.
MapId LargestMapOf(const std::vector<MapSummary>& maps);

// One run that added to the maps.
struct SessionSummary {
  std::string name;
  std::size_t num_keyframes = 0;
  Stamp first, last;  // of its keyframes, if it has any
};

// All sessions, in order.
std::vector<SessionSummary> SummariseSessions(const SavedMap& saved);

// What "map info --json" prints (docs/formats.md).
std::string FormatMapInfo(const SavedMap& saved, std::uintmax_t size_bytes);

// All keyframes and points as one JSON object (docs/formats.md). The file appears under its name
// only when complete.
void WriteMapJson(const std::filesystem::path& path, const SavedMap& saved);

}  // namespace cslam
