// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/actors/skeleton.h"

#include <algorithm>
#include <cmath>

namespace cslam {
namespace {

constexpr double kMaxStretch = 0.9995;  // of the limb's length: keeps the hinge's side defined

}  // namespace

Joint ParentOf(Joint joint) {
  switch (joint) {
    case kPelvis:
    case kWaist:
    case kThighL:
    case kThighR:
      return kPelvis;
    case kUpperArmL:
    case kUpperArmR:
    case kNeck:
      return kChest;
    default:
      return static_cast<Joint>(static_cast<std::size_t>(joint) - 1);
  }
}

LimbJoints ArmOf(Side side) {
  return side == Side::kLeft ? LimbJoints{kUpperArmL, kForearmL, kHandL}
                             : LimbJoints{kUpperArmR, kForearmR, kHandR};
}

LimbJoints LegOf(Side side) {
  return side == Side::kLeft ? LimbJoints{kThighL, kShinL, kFootL}
                             : LimbJoints{kThighR, kShinR, kFootR};
}

Joint ToesOf(Side side) {
  return side == Side::kLeft ? kToesL : kToesR;
}

Eigen::Vector3d Skeleton::OffsetOf(Joint joint) const {
  return T_body_joint[ParentOf(joint)].Inverse() * T_body_joint[joint].translation;
}

double Skeleton::UpperLength(const LimbJoints& limb) const {
  return OffsetOf(limb.middle).norm();
}

double Skeleton::LowerLength(const LimbJoints& limb) const {
  return OffsetOf(limb.end).norm();
}

Eigen::Quaterniond BoneRotation(const Eigen::Vector3d& along, const Eigen::Vector3d& hinge) {
  const Eigen::Vector3d z = -along.normalized();
  const Eigen::Vector3d y = (hinge - hinge.dot(z) * z).normalized();
  Eigen::Matrix3d axes;
  axes << y.cross(z), y, z;
  return Eigen::Quaterniond(axes).normalized();
}

BentLimb BendLimb(const Eigen::Vector3d& root, const Eigen::Vector3d& end,
                  const Eigen::Vector3d& pole, double upper_m, double lower_m, BendAxis axis) {
  const Eigen::Vector3d offset = end - root;
  const double shortest_m = std::abs(upper_m - lower_m) / kMaxStretch;
  const double reach_m =
      std::clamp(offset.norm(), shortest_m + 1e-6, kMaxStretch * (upper_m + lower_m));
  const Eigen::Vector3d along =
      offset.norm() > 1e-9 ? offset.normalized() : -Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d aside = (pole - pole.dot(along) * along).normalized();
  const double cosine =
      (upper_m * upper_m + reach_m * reach_m - lower_m * lower_m) / (2.0 * upper_m * reach_m);
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const Eigen::Vector3d middle = root + upper_m * (cosine * along + sine * aside);
  const Eigen::Vector3d hinge = axis == BendAxis::kKnee ? aside.cross(along) : along.cross(aside);
  BentLimb limb;
  limb.end = root + reach_m * along;
  limb.T_upper = Se3(BoneRotation(middle - root, hinge), root);
  limb.T_lower = Se3(BoneRotation(limb.end - middle, hinge), middle);
  return limb;
}

}  // namespace cslam
