// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"

#include <opencv2/core/mat.hpp>

#include <cstdint>

namespace cslam {

// A sensor that measures depth through disparity, so that its error grows with z squared. The
// defaults are those of structured light in the first Kinect. Disparities are those of a 640 px
// wide image whatever the size rendered, so that a small image is as noisy in metres as a large
// one.
struct DepthNoiseOptions {
  double baseline_m = 0.075;          // projector to camera
  double disparity_sigma_px = 0.025;  // independent from pixel to pixel
  double patch_sigma_px = 0.058;      // common to neighbours
  double patch_size_px = 8.0;         // size of such a neighbourhood
  double quantum_px = 0.125;          // step of the disparities
  double unit_m = 0.0;                // step of the depths reported; 0: none
  double min_depth_m = 0.45;
  double max_depth_m = 5.5;
  double edge_dropout = 0.6;      // chance that a pixel at a depth step gives nothing
  double edge_reach_px = 1.0;     // how far from a step that can happen
  double dropout_patch_px = 0.0;  // pixels drop out in patches of this size; 0: each by itself
  double edge_step = 0.04;        // what counts as a step: relative depth difference
  double grazing_cosine = 0.17;   // surfaces seen flatter than this (about 80 deg) drop out
};

// Active stereo with the D435i's 50 mm between its cameras: matching windows make errors common to
// neighbours and holes wider. 0.08 px of error, as Intel states; steps of 1/16 px, whole
// millimetres.
DepthNoiseOptions D435iDepthNoise();

// depth_m: H x W, CV_32FC1, exact; the result has 0 where the sensor gives nothing: out of range,
// in the projector's (second camera's) shadow, at edges, on grazing surfaces. Same seed and frame,
// same noise.
cv::Mat AddDepthNoise(const cv::Mat& depth_m, const Camera& camera,
                      const DepthNoiseOptions& options, std::uint64_t seed, std::uint64_t frame);

}  // namespace cslam
