// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include <filesystem>
#include <string_view>

namespace cslam {

// PNG (libpng) and JPEG (libturbojpeg), told apart by their first bytes. Every function throws
// Error with the path and the reason: missing, truncated, wrong type.

// H x W, CV_8UC3 in BGR order, from an 8-bit colour or grey image.
cv::Mat ReadColorImage(const std::filesystem::path& path);

// The same from a file's bytes; name stands for the path in errors.
cv::Mat DecodeColorImage(std::string_view bytes, const std::filesystem::path& name);

// H x W, CV_16UC1, from a 16-bit single-channel PNG; any other type is an error.
cv::Mat ReadDepthImage(const std::filesystem::path& path);

// CV_8UC1, CV_8UC3 (BGR) or CV_16UC1. compression: zlib level 0 to 9 (for colour: none or some).
// The file appears under its name only when complete.
void WritePng(const std::filesystem::path& path, const cv::Mat& image, int compression = 6);

}  // namespace cslam
