// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace cslam {

enum Joint : std::size_t {
  kPelvis,
  kWaist,
  kChest,
  kNeck,
  kHead,
  kUpperArmL,
  kForearmL,
  kHandL,
  kUpperArmR,
  kForearmR,
  kHandR,
  kThighL,
  kShinL,
  kFootL,
  kToesL,
  kThighR,
  kShinR,
  kFootR,
  kToesR,
  kNumJoints
};

// The joint each one hangs on; the pelvis hangs on itself.
Joint ParentOf(Joint joint);

enum class Side : std::size_t { kLeft, kRight };
constexpr std::array<Side, 2> kSides{Side::kLeft, Side::kRight};
constexpr double SignOf(Side side) {
  return side == Side::kLeft ? 1.0 : -1.0;
}  // of y

struct LimbJoints {
  Joint root;  // shoulder or hip
  Joint middle;
  Joint end;  // hand or foot
};
LimbJoints ArmOf(Side side);
LimbJoints LegOf(Side side);
Joint ToesOf(Side side);

// A frame per joint. With arms and legs hanging straight down, all frames are parallel to the
// body's: x forward, y left, z up. Elbows and knees bend about y.
using JointFrames = std::array<Se3, kNumJoints>;

// The body at rest: in the body's frame, whose origin is on the floor between the feet.
struct Skeleton {
  JointFrames T_body_joint;
  double buttock_m = 0.1;  // from the pelvis joint (between the hips) down to the seat
  double heel_m = 0.06;    // from the ankle back to where the heel touches the floor

  // Of a joint's origin in its parent's frame.
  Eigen::Vector3d OffsetOf(Joint joint) const;
  double UpperLength(const LimbJoints& limb) const;
  double LowerLength(const LimbJoints& limb) const;
};

// Two bones from root towards end, bent at the middle to the side of pole. Both frames have y along
// the hinge and -z along the bone.
struct BentLimb {
  Se3 T_upper;
  Se3 T_lower;
  Eigen::Vector3d end;  // as asked for, or as near as the limb reaches
};
enum class BendAxis { kElbow, kKnee };  // the pole is behind the hinge or before it
BentLimb BendLimb(const Eigen::Vector3d& root, const Eigen::Vector3d& end,
                  const Eigen::Vector3d& pole, double upper_m, double lower_m, BendAxis axis);

// x, y, z with -z along the bone and y as near to hinge as that allows.
Eigen::Quaterniond BoneRotation(const Eigen::Vector3d& along, const Eigen::Vector3d& hinge);

}  // namespace cslam
