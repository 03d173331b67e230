// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include <filesystem>

namespace cslam {

// Images whose pixels are instance ids: grey PNGs of 8 bits if the sequence has at most 255
// objects besides the room, otherwise of 16.

// H x W, CV_16UC1. Throws Error with the path and the reason for anything but a grey PNG of 8 or
// 16 bits.
cv::Mat ReadInstanceImage(const std::filesystem::path& path);

// instances: CV_16UC1; num_instances: of the whole sequence, the room included, above every pixel.
// The file appears under its name only when complete.
void WriteInstanceImage(const std::filesystem::path& path, const cv::Mat& instances,
                        int num_instances);

}  // namespace cslam
