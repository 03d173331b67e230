// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/optim/ba_residual.h"

#include <cmath>

namespace cslam {
namespace {

// J with ExpSo3(w + dw) = ExpSo3(J * dw) * ExpSo3(w) to first order.
Eigen::Matrix3d LeftJacobianSo3(const Eigen::Vector3d& w) {
  constexpr double kSmallAngle = 1e-4;
  const double angle = w.norm();
  const Eigen::Matrix3d W = Skew(w);
  if (angle < kSmallAngle) return Eigen::Matrix3d::Identity() + 0.5 * W + W * W / 6.0;
  const double angle2 = angle * angle;
  return Eigen::Matrix3d::Identity() + (1.0 - std::cos(angle)) / angle2 * W +
         (angle - std::sin(angle)) / (angle2 * angle) * W * W;
}

}  // namespace

Se3 MovedPose(const Se3& T_camera_world_start, const Vector6& move) {
  return Se3(ExpSo3(move.head<3>()), move.tail<3>()) * T_camera_world_start;
}

PoseChart MakePoseChart(const Se3& T_camera_world_start, const Vector6& move) {
  const Se3 T_camera_world = MovedPose(T_camera_world_start, move);
  return {.R_camera_world = T_camera_world.R(),
          .t_camera_world = T_camera_world.translation,
          .translation = move.tail<3>(),
          .left_jacobian = LeftJacobianSo3(move.head<3>())};
}

}  // namespace cslam
