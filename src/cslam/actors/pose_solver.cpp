// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/actors/pose_solver.h"

#include <algorithm>
#include <cmath>

namespace cslam {
namespace {

constexpr double kLegStretch = 0.996;     // people never walk with knees locked: at least 10 deg
constexpr double kSinkSharpness = 0.006;  // m; how softly the pelvis begins to sink
constexpr double kLowestPelvis = 0.6;     // of its height when standing
constexpr double kForearmTwist = 0.5;     // share of the hand's turn that the forearm takes

Eigen::Quaterniond About(const Eigen::Vector3d& axis, double angle_rad) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, axis));
}

// A smooth lower bound of the smallest.
double SoftMin(double a, double b, double c) {
  const double least = std::min({a, b, c});
  const auto term = [&](double x) { return std::exp((least - x) / kSinkSharpness); };
  return least - kSinkSharpness * std::log(term(a) + term(b) + term(c));
}

struct FootFrames {
  Se3 T_world_foot;
  Se3 T_world_toes;
};

FootFrames PlaceFoot(const Skeleton& skeleton, Side side, const FootGoal& goal) {
  const Joint ankle = LegOf(side).end;
  const double ankle_height_m = skeleton.T_body_joint[ankle].translation.z();
  const Eigen::Vector3d ball = skeleton.OffsetOf(ToesOf(side));
  const Eigen::Vector3d pivot(goal.pitch_rad > 0.0 ? ball.x() : -skeleton.heel_m, 0.0, 0.0);
  const Eigen::Quaterniond pitch = About(Eigen::Vector3d::UnitY(), goal.pitch_rad);
  const Eigen::Vector3d lift(0.0, 0.0, goal.lift_m);
  const Se3 T_sole_foot(pitch,
                        pivot + lift + pitch * (Eigen::Vector3d(0.0, 0.0, ankle_height_m) - pivot));
  const Se3 T_world_foot = goal.T_world_sole * T_sole_foot;
  const Se3 T_foot_toes(About(Eigen::Vector3d::UnitY(), -goal.toe_bend_rad), ball);
  return {T_world_foot, T_world_foot * T_foot_toes};
}

// How high the pelvis may be for the hip to reach the ankle.
double HighestPelvis(const Skeleton& skeleton, Side side, const Se3& T_world_pelvis,
                     const Eigen::Vector3d& ankle) {
  const LimbJoints leg = LegOf(side);
  const double reach_m = kLegStretch * (skeleton.UpperLength(leg) + skeleton.LowerLength(leg));
  const Eigen::Vector3d hip = T_world_pelvis * skeleton.OffsetOf(leg.root);
  const double aside_m = (hip - ankle).head<2>().norm();
  const double rise_m = std::sqrt(std::max(0.0, reach_m * reach_m - aside_m * aside_m));
  return ankle.z() + rise_m - (hip.z() - T_world_pelvis.translation.z());
}

Se3 PlacePelvis(const Skeleton& skeleton, const PersonPose& pose,
                const std::array<FootFrames, 2>& feet) {
  const double standing_m = skeleton.T_body_joint[kPelvis].translation.z();
  Eigen::Vector3d place = pose.pelvis_shift_m;
  if (pose.seat_height_m) {
    place.z() += *pose.seat_height_m + skeleton.buttock_m;
  } else {
    place.z() += standing_m;
  }
  Se3 T_world_pelvis = pose.T_world_body * Se3(ExpSo3(pose.pelvis_turn_rad), place);
  if (pose.seat_height_m) return T_world_pelvis;
  std::array<double, 2> limits{};
  for (std::size_t i = 0; i < 2; ++i) {
    limits[i] =
        HighestPelvis(skeleton, kSides[i], T_world_pelvis, feet[i].T_world_foot.translation);
  }
  double& height = T_world_pelvis.translation.z();
  height = std::max(SoftMin(height, limits[0], limits[1]),
                    pose.T_world_body.translation.z() + kLowestPelvis * standing_m);
  return T_world_pelvis;
}

void PlaceTrunk(const Skeleton& skeleton, const PersonPose& pose, JointFrames& frames) {
  const Eigen::Quaterniond& body = pose.T_world_body.rotation;
  const Eigen::Quaterniond pelvis = frames[kPelvis].rotation;
  const Eigen::Quaterniond chest = body * ExpSo3(pose.chest_turn_rad);
  const Eigen::Quaterniond head = body * ExpSo3(pose.head_turn_rad);
  const auto place = [&](Joint joint, const Eigen::Quaterniond& rotation) {
    frames[joint] = Se3(rotation, frames[ParentOf(joint)] * skeleton.OffsetOf(joint));
  };
  place(kWaist, pelvis.slerp(0.5, chest));
  place(kChest, chest);
  place(kNeck, chest.slerp(0.5, head));
  place(kHead, head);
}

void PlaceArm(const Skeleton& skeleton, const PersonPose& pose, Side side, JointFrames& frames) {
  const LimbJoints arm = ArmOf(side);
  const ArmGoal& goal = pose.arms[static_cast<std::size_t>(side)];
  const double sign = SignOf(side);
  const double upper_m = skeleton.UpperLength(arm);
  const double lower_m = skeleton.LowerLength(arm);
  const Eigen::Vector3d shoulder = frames[kChest] * skeleton.OffsetOf(arm.root);
  const Eigen::Quaterniond upper = frames[kChest].rotation *
                                   About(Eigen::Vector3d::UnitX(), sign * goal.spread_rad) *
                                   About(Eigen::Vector3d::UnitY(), -goal.swing_rad);
  const Eigen::Quaterniond lower = upper * About(Eigen::Vector3d::UnitY(), -goal.elbow_rad);
  const Eigen::Vector3d down = -Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d swung = shoulder + upper * (upper_m * down) + lower * (lower_m * down);
  const Eigen::Vector3d hand =
      (1.0 - goal.reach) * swung + goal.reach * (pose.T_world_body * goal.hand_m);
  const Eigen::Vector3d outward_pole(goal.elbow_pole.x(), sign * goal.elbow_pole.y(),
                                     goal.elbow_pole.z());
  const Eigen::Vector3d pole = (1.0 - goal.reach) * (upper * -Eigen::Vector3d::UnitX()) +
                               goal.reach * (pose.T_world_body.rotation * outward_pole);
  const BentLimb limb = BendLimb(shoulder, hand, pole, upper_m, lower_m, BendAxis::kElbow);
  const double palm_rad = -sign * goal.palm_down_rad;
  const auto twist = [](double angle_rad) { return About(Eigen::Vector3d::UnitZ(), angle_rad); };
  frames[arm.root] = limb.T_upper;
  frames[arm.middle] =
      Se3(limb.T_lower.rotation * twist(kForearmTwist * palm_rad), limb.T_lower.translation);
  frames[arm.end] = Se3(limb.T_lower.rotation * twist(palm_rad), limb.end);
}

void PlaceLeg(const Skeleton& skeleton, Side side, const FootFrames& foot, JointFrames& frames) {
  const LimbJoints leg = LegOf(side);
  const Eigen::Vector3d hip = frames[kPelvis] * skeleton.OffsetOf(leg.root);
  // The knee points where pelvis and foot do, on average; the foot's yaw alone when it is pitched.
  const Eigen::Vector3d pelvis_forward = frames[kPelvis].rotation * Eigen::Vector3d::UnitX();
  const Eigen::Vector3d left = foot.T_world_foot.rotation * Eigen::Vector3d::UnitY();
  const Eigen::Vector3d pole = pelvis_forward + left.cross(Eigen::Vector3d::UnitZ());
  const BentLimb limb =
      BendLimb(hip, foot.T_world_foot.translation, pole, skeleton.UpperLength(leg),
               skeleton.LowerLength(leg), BendAxis::kKnee);
  const Eigen::Vector3d shift = limb.end - foot.T_world_foot.translation;
  frames[leg.root] = limb.T_upper;
  frames[leg.middle] = limb.T_lower;
  frames[leg.end] = Se3(foot.T_world_foot.rotation, limb.end);
  frames[ToesOf(side)] = Se3(foot.T_world_toes.rotation, foot.T_world_toes.translation + shift);
}

}  // namespace

JointFrames SolvePose(const Skeleton& skeleton, const PersonPose& pose) {
  const std::array<FootFrames, 2> feet{PlaceFoot(skeleton, Side::kLeft, pose.feet[0]),
                                       PlaceFoot(skeleton, Side::kRight, pose.feet[1])};
  JointFrames frames;
  frames[kPelvis] = PlacePelvis(skeleton, pose, feet);
  PlaceTrunk(skeleton, pose, frames);
  for (const Side side : kSides) {
    PlaceArm(skeleton, pose, side, frames);
    PlaceLeg(skeleton, side, feet[static_cast<std::size_t>(side)], frames);
  }
  return frames;
}

PersonPose StandingPose() {
  constexpr double kHalfStance = 0.09;  // m
  PersonPose pose;
  for (const Side side : kSides) {
    pose.feet[static_cast<std::size_t>(side)].T_world_sole.translation.y() =
        SignOf(side) * kHalfStance;
  }
  return pose;
}

}  // namespace cslam
