// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/geometry/se3.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cslam {

class OptionList;

// One known 3D point seen in the image.
struct PoseObservation {
  Eigen::Vector3d p_world = Eigen::Vector3d::Zero();  // metres
  Eigen::Vector2d uv_px = Eigen::Vector2d::Zero();    // undistorted
  double disparity_px = -1.0;          // fx * baseline / z of the depth reading; negative: none
  double information_px = 1.0;         // 1 / sigma^2 of u and v
  double information_disparity = 1.0;  // 1 / sigma^2 of the disparity
  double weight = 1.0;                 // its say in the pose; inliers are judged without it
};

struct PoseOptimizerOptions {
  int rounds = 4;                 // outliers are judged anew after each
  int iterations_per_round = 10;  // Levenberg-Marquardt steps at most
  double chi2_mono = 5.991;       // chi2, 2 dof, 95 %
  double chi2_depth = 7.815;      // chi2, 3 dof, 95 %
  // Cauchy's kernel is on in every round: among the inliers a gate lets through are wrong matches,
  // and a plain least-squares pose jitters with them (rendered room without noise: 2.7 mm a frame;
  // 1.0 mm with this kernel and that of bundle adjustment).
  double kernel_chi2 = 1.0;  // squared error at which an observation's weight has halved
};

void Describe(OptionList& list, PoseOptimizerOptions& options);

struct PoseSolution {
  Se3 T_world_camera;
  std::vector<std::uint8_t> is_inlier;  // one per observation
  int num_inliers = 0;
  double mean_chi2 = 0.0;  // over inliers
  int iterations = 0;      // over all rounds
  // Of T_world_camera, from the inliers; tangent [rotation, translation], T * Exp(x).
  Matrix6 information = Matrix6::Zero();
};

// Motion-only optimisation: the pose that best explains the observations, starting from
// T_world_camera. baseline_m is the virtual stereo baseline. Observations with a non-finite number
// or without positive information and weight are never inliers. With fewer than three usable
// observations, or a start pose that is not finite, the start pose comes back. Deterministic.
PoseSolution OptimizePose(const Camera& camera, double baseline_m, const Se3& T_world_camera,
                          std::span<const PoseObservation> observations,
                          const PoseOptimizerOptions& options);

}  // namespace cslam
