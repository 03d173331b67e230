// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/camera_path.h"

#include "cslam/sim/simulated_sequence.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace cslam {
namespace {

constexpr HandWobble kSteady{.position_m = 0.0, .rotation_rad = 0.0, .seed = 1};

CameraPath StraightPath() {
  return {{{{0.0, 0.0, 1.0}, 0.0, 0.0}, {{1.0, 0.0, 1.0}, 0.0, 0.0}, {{2.0, 0.0, 1.0}, 0.0, 0.0}},
          6.0,
          kSteady};
}

TEST(PoseAt, LooksAlongYawAndPitchWithTheHorizonLevel) {
  const Se3 east = PoseAt({{1.0, 2.0, 3.0}, 0.0, 0.0});
  EXPECT_TRUE((east * Eigen::Vector3d(0.0, 0.0, 1.0)).isApprox(Eigen::Vector3d(2.0, 2.0, 3.0)));
  EXPECT_TRUE((east * Eigen::Vector3d(1.0, 0.0, 0.0)).isApprox(Eigen::Vector3d(1.0, 1.0, 3.0)));
  EXPECT_TRUE((east * Eigen::Vector3d(0.0, 1.0, 0.0)).isApprox(Eigen::Vector3d(1.0, 2.0, 2.0)));
  const Se3 north_up = PoseAt({{0.0, 0.0, 0.0}, 0.5 * std::numbers::pi, 0.3});
  const Eigen::Vector3d forward = north_up.R().col(2);
  EXPECT_NEAR(forward.z(), std::sin(0.3), 1e-12);
  EXPECT_NEAR(forward.y(), std::cos(0.3), 1e-12);
  EXPECT_NEAR(north_up.R().determinant(), 1.0, 1e-12);
}

TEST(CameraPath, StartsAndEndsAtRestAtTheOuterKeys) {
  const CameraPath path = StraightPath();
  EXPECT_TRUE(path.T_world_camera(0.0).translation.isApprox(Eigen::Vector3d(0.0, 0.0, 1.0), 1e-9));
  EXPECT_TRUE(path.T_world_camera(6.0).translation.isApprox(Eigen::Vector3d(2.0, 0.0, 1.0), 1e-9));
  EXPECT_TRUE(path.T_world_camera(9.0).translation.isApprox(Eigen::Vector3d(2.0, 0.0, 1.0), 1e-9));
  EXPECT_LT(Difference(path.T_world_camera(0.0), path.T_world_camera(0.05)).distance_m, 1e-4);
}

TEST(CameraPath, MovesWithoutJumpsInSpeed) {
  const CameraPath path = StraightPath();
  constexpr double kStepS = 0.01;
  double previous_m = 0.0;
  for (double t = 0.0; t < 6.5; t += kStepS) {
    const double step_m =
        path.T_world_camera(t + kStepS).translation.x() - path.T_world_camera(t).translation.x();
    EXPECT_GE(step_m, -1e-12) << "at " << t;
    EXPECT_LT(std::abs(step_m - previous_m), 2e-4) << "at " << t;
    previous_m = step_m;
  }
}

TEST(CameraPath, WobblesALittleAndDifferentlyForEverySeed) {
  const std::vector<PathKey> keys{{{0.0, 0.0, 1.0}, 0.0, 0.0}};
  const CameraPath one(keys, 2.0, HandWobble{.seed = 1});
  const CameraPath same(keys, 2.0, HandWobble{.seed = 1});
  const CameraPath other(keys, 2.0, HandWobble{.seed = 2});
  double largest_m = 0.0;
  for (double t = 0.0; t < 5.0; t += 0.1) {
    const Se3 pose = one.T_world_camera(t);
    largest_m = std::max(largest_m, (pose.translation - keys[0].position).norm());
    EXPECT_EQ(pose.Matrix(), same.T_world_camera(t).Matrix());
  }
  EXPECT_GT(largest_m, 0.001);
  EXPECT_LT(largest_m, 0.01);
  EXPECT_GT(Difference(one.T_world_camera(1.0), other.T_world_camera(1.0)).distance_m, 1e-5);
}

TEST(MakeDemoPath, TravelsAndTurnsAsPromisedAtTheSpeedOfACarefulHand) {
  const CameraPath path = MakeDemoPath(1);
  constexpr double kStepS = 1.0 / 30.0;
  double length_m = 0.0;
  double turned_rad = 0.0;
  for (double t = 0.0; t + kStepS <= path.duration_s(); t += kStepS) {
    const PoseDifference step = Difference(path.T_world_camera(t), path.T_world_camera(t + kStepS));
    length_m += step.distance_m;
    turned_rad += step.angle_rad;
    EXPECT_LT(step.distance_m / kStepS, 0.65) << "at " << t;
    EXPECT_LT(step.angle_rad / kStepS, 45.0 * std::numbers::pi / 180.0) << "at " << t;
  }
  EXPECT_GT(length_m, 6.0);
  EXPECT_GT(turned_rad, 2.0 * std::numbers::pi);
  const PoseDifference end = Difference(path.T_world_camera(0.0), path.T_world_camera(20.0));
  EXPECT_LT(end.distance_m, 0.05);
  EXPECT_LT(end.angle_rad, 0.1);
}

}  // namespace
}  // namespace cslam
