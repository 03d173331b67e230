// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"

#include <opencv2/core/mat.hpp>

#include <cstdint>

namespace cslam {

// A structured-light sensor such as the first Kinect: depth comes from disparity, so its error
// grows with z squared. Disparities are those of a 640 px wide image whatever the size rendered,
// so that a small image is as noisy in metres as a large one.
struct DepthNoiseOptions {
  double baseline_m = 0.075;         // projector to camera
  double disparity_sigma_px = 0.05;  // independent from pixel to pixel
  double patch_sigma_px = 0.04;      // common to neighbours
  double patch_size_px = 8.0;        // size of such a neighbourhood
  double quantum_px = 0.125;         // step of the disparities
  double min_depth_m = 0.45;
  double max_depth_m = 5.5;
  double edge_dropout = 0.6;     // chance that a pixel at a depth step gives nothing
  double edge_step = 0.04;       // what counts as a step: relative depth difference
  double grazing_cosine = 0.17;  // surfaces seen flatter than this (about 80 deg) drop out
};

// depth_m: H x W, CV_32FC1, exact; the result has 0 where the sensor gives nothing: out of range,
// in the projector's shadow, at edges, on grazing surfaces. Same seed and frame, same noise.
cv::Mat AddDepthNoise(const cv::Mat& depth_m, const Camera& camera,
                      const DepthNoiseOptions& options, std::uint64_t seed, std::uint64_t frame);

struct ColorNoiseOptions {
  double sigma = 2.0;        // grey levels, per channel
  double vignetting = 0.12;  // share of light lost in the corners
};

// bgr: H x W, CV_8UC3.
cv::Mat AddColorNoise(const cv::Mat& bgr, const ColorNoiseOptions& options, std::uint64_t seed,
                      std::uint64_t frame);

}  // namespace cslam
