// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/geometry/se3.h"
#include "cslam/optim/pose_optimizer.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cslam {

class OptionList;

// Camera poses (T_world_camera) from which three world points lie on three rays; up to four.
// rays: in the camera frame, of any length.
std::vector<Se3> SolveP3p(const std::array<Eigen::Vector3d, 3>& p_world,
                          const std::array<Eigen::Vector3d, 3>& rays);

struct PoseRansacOptions {
  int max_iterations = 1000;
  double confidence = 0.99;
  // Gates four times the 95 % quantiles, as the tracker's: motion blur shifts corners by more than
  // their nominal sigma.
  double chi2_mono = 4.0 * 5.991;
  double chi2_depth = 4.0 * 7.815;
};
void Describe(OptionList& list, PoseRansacOptions& options);

struct PoseRansacResult {
  Se3 T_world_camera;
  std::vector<std::uint8_t> is_inlier;  // one per observation
  int num_inliers = 0;                  // 0: no pose was found
  int iterations = 0;
};

// The pose most observations agree with, wrong ones among them. Three observations with depth
// give a pose by aligning points, others by their rays. The result depends on the arguments alone.
PoseRansacResult FindPose(const Camera& camera, double baseline_m,
                          std::span<const PoseObservation> observations,
                          const PoseRansacOptions& options, std::uint64_t seed);

}  // namespace cslam
