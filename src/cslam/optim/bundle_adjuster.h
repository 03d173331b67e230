// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/geometry/se3.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace cslam {

class OptionList;

// Point number `point` seen by camera pose number `pose`.
struct BaObservation {
  int pose = 0;
  int point = 0;
  Eigen::Vector2d uv_px = Eigen::Vector2d::Zero();  // undistorted
  double disparity_px = -1.0;                       // fx * baseline / z; negative: no depth reading
  double information_px = 1.0;                      // 1 / sigma^2 of u and v
  double information_disparity = 1.0;               // 1 / sigma^2 of the disparity
};

// A bundle adjustment as plain arrays: no map, no ids.
struct BaProblem {
  Camera camera;
  double baseline_m = 0.08;
  std::vector<Se3> T_world_camera;
  std::vector<std::uint8_t> pose_is_fixed;  // one per pose
  std::vector<Eigen::Vector3d> p_world;
  std::vector<BaObservation> observations;
};

struct BundleAdjusterOptions {
  int iterations_robust = 5;  // first round, over all observations
  int iterations_final = 10;  // second round, outliers left out
  double kernel_chi2 = 1.0;   // squared error beyond which Huber's kernel grows linearly, in both
  double chi2_mono = 5.991;   // chi2, 2 dof, 95 %
  double chi2_depth = 7.815;  // chi2, 3 dof, 95 %
  // A round ends early once a step lowers the cost by less than this share.
  double function_tolerance = 1e-4;
};

void Describe(OptionList& list, BundleAdjusterOptions& options);

struct BaResult {
  std::vector<Se3> T_world_camera;  // fixed ones unchanged
  std::vector<Eigen::Vector3d> p_world;
  std::vector<std::uint8_t> is_outlier;  // one per observation, judged at the solution
  double initial_cost = 0.0;  // half the sum of chi2, robust, over all that can be judged
  double final_cost = 0.0;    // half the sum of chi2 over the observations kept
  int iterations = 0;         // over both rounds
  bool was_stopped = false;   // should_stop said so; the arrays hold the best so far
};

// Minimises reprojection and disparity errors over free poses and all points. Poses and points
// without a usable observation stay where they are; observations that are not finite or lie behind
// their camera are outliers. should_stop is asked before each iteration (may be empty).
// Single-threaded and deterministic.
BaResult AdjustBundle(const BaProblem& problem, const BundleAdjusterOptions& options,
                      const std::function<bool()>& should_stop = {});

}  // namespace cslam
