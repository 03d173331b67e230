// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/actors/skeleton.h"
#include "cslam/geometry/se3.h"

#include <Eigen/Core>

#include <array>
#include <optional>

namespace cslam {

// Where one foot is to be. The sole's frame is on the floor below the ankle, x along the foot.
struct FootGoal {
  Se3 T_world_sole;
  double lift_m = 0.0;        // of the whole foot
  double pitch_rad = 0.0;     // > 0: on the ball, heel up; < 0: on the heel, toes up
  double toe_bend_rad = 0.0;  // of the toes against the foot, up
};

struct ArmGoal {
  double swing_rad = 0.0;   // of the upper arm, forward
  double spread_rad = 0.1;  // of the upper arm, away from the body
  double elbow_rad = 0.2;
  double palm_down_rad = 0.0;  // turn of the hand from palm inwards
  // With reach > 0 the hand goes from where the angles put it (0) to this place (1).
  double reach = 0.0;
  Eigen::Vector3d hand_m = Eigen::Vector3d::Zero();  // body frame
  Eigen::Vector3d elbow_pole{-0.5, 0.0, -0.8};       // body frame, y outwards
};

// What a body is to do at one instant, whatever its size; a skeleton's own lengths make joint
// angles of it (SolvePose). Rotations are rotation vectors in the body's frame.
struct PersonPose {
  Se3 T_world_body;                                          // on the floor, x forward
  std::optional<double> seat_height_m;                       // sits on it
  Eigen::Vector3d pelvis_shift_m = Eigen::Vector3d::Zero();  // body frame; z: against standing
  Eigen::Vector3d pelvis_turn_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d chest_turn_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d head_turn_rad = Eigen::Vector3d::Zero();
  std::array<FootGoal, 2> feet;  // by Side
  std::array<ArmGoal, 2> arms;   // by Side
};

}  // namespace cslam
