// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"
#include "cslam/optim/residuals.h"

#include <Eigen/Core>

namespace cslam {

// A camera pose during a bundle adjustment, moved from where the round began by six plain numbers
// [rotation (rad), translation (m)] in the camera frame:
//   T_camera_world = (ExpSo3(rotation), translation) * T_camera_world_start.
// Six free numbers need no manifold; a round turns a camera by far less than pi.
struct PoseChart {
  Eigen::Matrix3d R_camera_world;
  Eigen::Vector3d t_camera_world;
  Eigen::Vector3d translation;    // of the move
  Eigen::Matrix3d left_jacobian;  // of SO(3) at the move's rotation
};

PoseChart MakePoseChart(const Se3& T_camera_world_start, const Vector6& move);
Se3 MovedPose(const Se3& T_camera_world_start, const Vector6& move);  // T_camera_world

// Behind the camera the error is constant: in sigmas, small enough that one weak point which a
// step throws there cannot block the step for all others, large enough to be an outlier.
inline constexpr double kBehindError = 10.0;

// The error of one observation in units of sigma, rows [u, v, disparity]; the disparity row is zero
// without a depth reading. p_camera is the point in the camera frame of the pose. Inline: a bundle
// adjustment spends its evaluations here.
inline Eigen::Vector3d BaError(const PixelDisparityModel& model, const Measurement& measurement,
                               const Eigen::Vector3d& p_camera) {
  if (!(p_camera.z() >= kMinProjectionDepth)) return {kBehindError, 0.0, 0.0};
  return (model.Predict(p_camera) - measurement.value).cwiseProduct(measurement.sqrt_information);
}

// 3x3: derivatives of BaError by p_camera, which are those by the move's translation too.
inline Eigen::Matrix3d BaErrorByTranslation(const PixelDisparityModel& model,
                                            const Measurement& measurement,
                                            const Eigen::Vector3d& p_camera) {
  if (!(p_camera.z() >= kMinProjectionDepth)) return Eigen::Matrix3d::Zero();
  return measurement.sqrt_information.asDiagonal() * model.Jacobian(p_camera);
}

// 3x3: by the move's rotation, which turns the point about the start's camera centre.
inline Eigen::Matrix3d BaErrorByRotation(const Eigen::Matrix3d& by_translation,
                                         const PoseChart& pose, const Eigen::Vector3d& p_camera) {
  const Eigen::Vector3d arm = pose.translation - p_camera;
  Eigen::Matrix3d by_turn;  // each row times Skew(arm)
  for (int row = 0; row < 3; ++row) {
    const Eigen::Vector3d r = by_translation.row(row);
    by_turn.row(row) = r.cross(arm);
  }
  return by_turn * pose.left_jacobian;
}

}  // namespace cslam
