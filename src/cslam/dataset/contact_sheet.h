// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/truth_files.h"

#include <opencv2/core/mat.hpp>

#include <filesystem>
#include <span>

namespace cslam {

struct SheetFrame {
  double time_s = 0.0;
  std::filesystem::path image;  // colour
};

// Up to 4 x 3 small pictures, evenly spread over the frames, each with its time and, below, what
// has changed since the one before. CV_8UC3. frames: in order of time, at least one.
cv::Mat MakeContactSheet(std::span<const SheetFrame> frames, const TrueObjects& objects,
                         const TrueChanges& changes);

}  // namespace cslam
