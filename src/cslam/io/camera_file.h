// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cslam {

// A camera, the unit of its depth images, and where both come from.
struct CameraConfig {
  Camera camera;
  double depth_units_per_m = 5000.0;  // value of a depth pixel one metre away
  std::string name;                   // preset or file
  std::string source;                 // how it was chosen, for people
  bool approximate = false;           // typical values of the type, not a calibration
};

const std::vector<CameraConfig>& CameraPresets();

// The names of all presets with commas between, approximate ones marked.
std::string DescribeCameraPresets();

std::optional<CameraConfig> FindCameraPreset(std::string_view name);

// Reads a camera.yaml (docs/datasets.md): width, height [px]; fx, fy, cx, cy [px]; optional k1, k2,
// p1, p2, k3 and name; depth_scale [units per metre]. Throws Error with file:line for anything
// missing, unknown, twice there, not a finite number or out of range.
CameraConfig ReadCameraFile(const std::filesystem::path& path);

// The text ReadCameraFile() takes back without loss.
std::string FormatCamera(const CameraConfig& config);

void WriteCameraFile(const std::filesystem::path& path, const CameraConfig& config);

struct CameraChoice {
  std::string camera;                       // preset or file; empty: look at the data set
  std::optional<double> depth_units_per_m;  // overrides that of the camera
};

// The camera of the data set in folder: the choice, else its camera.yaml, else the preset that the
// folder's name (or that of the folder above) speaks of: fr1, freiburg1, ..., bonn; absent when
// none applies. Throws Error for a choice or a file that is wrong.
std::optional<CameraConfig> FindCamera(const std::filesystem::path& folder,
                                       const CameraChoice& choice);

// What to tell the user then: it lists the presets.
std::string MissingCameraMessage(const std::filesystem::path& folder);

// The same, but not knowing a camera is an Error, too.
CameraConfig ResolveCamera(const std::filesystem::path& folder, const CameraChoice& choice);

}  // namespace cslam
