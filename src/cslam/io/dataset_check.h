// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/camera_file.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cslam {

// What `changing-slam dataset check` found. Errors make `run` fail or skip frames; warnings are
// things a person should know. Each is one line; long series end with "... and N more".
struct DatasetCheck {
  std::vector<std::string> errors;
  std::vector<std::string> warnings;
  std::size_t num_frames = 0;
  std::size_t num_checked = 0;  // frames whose images were decoded
  std::size_t num_missing = 0;
  std::size_t num_unreadable = 0;
  std::size_t num_wrong_size = 0;
  std::size_t num_without_depth = 0;  // decoded, but without a single reading
  double depth_valid_share = 0.0;     // mean over the checked frames, 0 to 1
  double median_depth_m = 0.0;
};

// Looks at everything: lists, files, order, sizes, types, depth, pauses, ground truth. Decodes all
// images, or num_samples of them, evenly spread. Broken lists are findings; throws Error only if
// folder is no data set at all.
DatasetCheck CheckDataset(const std::filesystem::path& folder, const CameraChoice& choice,
                          std::optional<std::size_t> num_samples = {});

}  // namespace cslam
