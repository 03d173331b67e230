// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/actors/pose_solver.h"

#include "cslam/actors/plain_body.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cslam {
namespace {

TEST(BendLimb, ReachesTheGoalAndBendsToThePole) {
  const Eigen::Vector3d goal(0.3, 0.1, -0.4);
  const BentLimb limb =
      BendLimb(Eigen::Vector3d::Zero(), goal, Eigen::Vector3d::UnitX(), 0.4, 0.35, BendAxis::kKnee);
  EXPECT_LT((limb.end - goal).norm(), 1e-9);
  EXPECT_NEAR(limb.T_lower.translation.norm(), 0.4, 1e-9);
  EXPECT_NEAR((limb.T_lower.translation - goal).norm(), 0.35, 1e-9);
  const Eigen::Vector3d along = goal.normalized();
  const Eigen::Vector3d knee = limb.T_lower.translation;
  EXPECT_GT((knee - knee.dot(along) * along).x(), 0.05);
  const Eigen::Vector3d tip = limb.T_lower * Eigen::Vector3d(0.0, 0.0, -0.35);
  EXPECT_LT((tip - goal).norm(), 1e-9);
}

TEST(BendLimb, StopsAtFullLengthWhenTheGoalIsTooFar) {
  const BentLimb limb = BendLimb(Eigen::Vector3d::Zero(), {0.0, 0.0, -2.0},
                                 Eigen::Vector3d::UnitX(), 0.4, 0.35, BendAxis::kKnee);
  EXPECT_NEAR(limb.end.norm(), 0.75, 0.001);
  EXPECT_TRUE(limb.T_upper.IsFinite());
}

TEST(SolvePose, KeepsTheRestPoseWhenStanding) {
  const Skeleton skeleton = PlainSkeleton(1.75);
  const JointFrames frames = SolvePose(skeleton, StandingPose());
  for (const Joint joint : {kHead, kPelvis, kFootL, kFootR, kToesL}) {
    EXPECT_LT((frames[joint].translation - skeleton.T_body_joint[joint].translation).norm(), 0.03)
        << joint;
  }
}

TEST(SolvePose, KeepsBoneLengthsInAnyPose) {
  const Skeleton skeleton = PlainSkeleton(1.8);
  PersonPose pose = StandingPose();
  pose.seat_height_m = 0.45;
  pose.chest_turn_rad = {0.1, 0.4, 0.3};
  pose.arms[0].reach = 1.0;
  pose.arms[0].hand_m = {0.5, 0.1, 1.0};
  pose.feet[1].T_world_sole.translation.x() = 0.3;
  pose.feet[1].pitch_rad = 0.5;
  pose.feet[1].toe_bend_rad = 0.5;
  const JointFrames frames = SolvePose(skeleton, pose);
  for (std::size_t j = 1; j < kNumJoints; ++j) {
    const auto joint = static_cast<Joint>(j);
    const Eigen::Vector3d offset = frames[ParentOf(joint)].Inverse() * frames[joint].translation;
    EXPECT_NEAR(offset.norm(), skeleton.OffsetOf(joint).norm(), 1e-6) << j;
  }
}

TEST(SolvePose, SinksThePelvisWhenTheFeetAreFarApart) {
  const Skeleton skeleton = PlainSkeleton(1.75);
  PersonPose pose = StandingPose();
  const double standing_m = SolvePose(skeleton, pose)[kPelvis].translation.z();
  pose.feet[0].T_world_sole.translation.x() = 0.4;
  pose.feet[1].T_world_sole.translation.x() = -0.4;
  const JointFrames frames = SolvePose(skeleton, pose);
  EXPECT_LT(frames[kPelvis].translation.z(), standing_m - 0.05);
  EXPECT_NEAR(frames[kFootL].translation.x(), 0.4, 0.01);  // still reached
}

}  // namespace
}  // namespace cslam
