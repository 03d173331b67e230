// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include <cstdint>

namespace cslam {

// What lens, sensor and the camera's own processing do to a picture. The defaults are those of a
// first Kinect. Lengths are those of a 640 px wide image.
struct ColorNoiseOptions {
  double sigma = 0.8;          // grey levels, per channel, independent from pixel to pixel
  double patch_sigma = 1.2;    // grey levels, per channel, common to neighbours: what a camera's
                               // own noise filter leaves
  double patch_size_px = 2.5;  // size of such a neighbourhood
  double softness_px = 0.5;    // sigma of the blur by lens and demosaicing
  double vignetting = 0.12;    // share of light lost in the corners
  double exposure = 1.0;       // factor on the light
};

ColorNoiseOptions D435iColorNoise();

// bgr: H x W, CV_8UC3. Same seed and frame, same noise.
cv::Mat AddColorNoise(const cv::Mat& bgr, const ColorNoiseOptions& options, std::uint64_t seed,
                      std::uint64_t frame);

// bgr as it is with more or less light, and nothing else changed.
cv::Mat Expose(const cv::Mat& bgr, double exposure);

}  // namespace cslam
