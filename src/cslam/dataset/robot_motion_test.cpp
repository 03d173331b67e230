// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/robot_motion.h"

#include "cslam/util/check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cslam {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr RobotBody kSmooth{.camera_pitch_rad = 0.0, .shake_m = 0.0, .shake_rad = 0.0};

Eigen::Vector2d PlaceAt(const RobotRide& ride, double t) {
  return ride.camera.T_world_camera(t).translation.head<2>();
}

double YawDegAt(const RobotRide& ride, double t) {
  const Eigen::Vector3d forward = ride.camera.T_world_camera(t).R().col(2);
  return std::atan2(forward.y(), forward.x()) / kRadPerDeg;
}

TEST(FloorCurve, PassesItsPointsAtTheLengthsBetweenThem) {
  const FloorCurve curve({{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}});
  EXPECT_NEAR(curve.length_m(), 2.0, 1e-6);
  EXPECT_NEAR((curve.At(0.5) - Eigen::Vector2d(0.5, 0.0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((curve.At(9.0) - Eigen::Vector2d(2.0, 0.0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((curve.At(-1.0) - Eigen::Vector2d(0.0, 0.0)).norm(), 0.0, 1e-6);
}

TEST(FloorCurve, AdvancesEvenlyRoundABend) {
  const FloorCurve curve({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}});
  constexpr double kStepM = 0.01;
  for (double s = 0.0; s + kStepM < curve.length_m(); s += kStepM)
    EXPECT_NEAR((curve.At(s + kStepM) - curve.At(s)).norm(), kStepM, 0.02 * kStepM) << s;
}

TEST(RobotPlan, EndsWhereItWasSentAndLooksWhereItWasTold) {
  RobotPlan plan({1.0, 1.0}, 0.0, {}, 1);
  plan.Stand(1.0);
  plan.Ride({{2.0, 1.5}, {3.0, 1.0}});
  plan.Face({3.0, 4.0});
  plan.Turn(30.0);
  const RobotRide ride = plan.Finish(30.0, kSmooth);
  EXPECT_NEAR((PlaceAt(ride, 30.0) - Eigen::Vector2d(3.0, 1.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(YawDegAt(ride, 30.0), 120.0, 1e-9);
  EXPECT_NEAR(ride.camera.T_world_camera(9.0).translation.z(), 0.4, 1e-12);
}

TEST(RobotPlan, RideAndFaceAddsFullTurnsToTheShorterWay) {
  RobotPlan plan({0.0, 0.0}, 90.0, {}, 1);
  plan.Stand(1.0);
  plan.RideAndFace({{1.0, 0.0}}, {2.0, 0.0}, 1);
  EXPECT_NEAR(plan.turning_deg(), 270.0, 1e-6);
  EXPECT_NEAR(YawDegAt(plan.Finish(20.0, kSmooth), 20.0), 0.0, 1e-6);
}

TEST(RobotPlan, OrbitKeepsTheGazeOnTheCentreAndReachesTheRadius) {
  RobotPlan plan({0.0, -2.0}, 0.0, {}, 1);
  plan.Stand(1.0);
  plan.Orbit({0.0, 0.0}, 80.0, 1.5);
  const double moving_s = plan.moving_s();
  const RobotRide ride = plan.Finish(moving_s + 1.0, kSmooth);
  EXPECT_NEAR(PlaceAt(ride, moving_s + 1.0).norm(), 1.5, 1e-6);
  for (double t = 4.0; t < moving_s + 1.0; t += 0.1) {
    const Eigen::Vector2d to_centre = -PlaceAt(ride, t);
    EXPECT_NEAR(YawDegAt(ride, t), std::atan2(to_centre.y(), to_centre.x()) / kRadPerDeg, 1e-6);
  }
}

TEST(RobotPlan, StretchesPausesAndSetsMarksInTheirMiddle) {
  RobotPlan plan({0.0, 0.0}, 0.0, {}, 1);
  plan.Stand(1.0);
  plan.Turn(90.0);
  const double turning_s = plan.moving_s();
  plan.StandForChange(3.0);
  const RobotRide ride = plan.Finish(turning_s + 8.0, kSmooth);
  ASSERT_EQ(ride.marks_s.size(), 1U);
  EXPECT_NEAR(ride.marks_s[0], 2.0 + turning_s + 3.0, 1e-9);
  EXPECT_DOUBLE_EQ(ride.camera.duration_s, turning_s + 8.0);
}

TEST(RobotPlan, RefusesATimeTooShortForItsMoves) {
  RobotPlan plan({0.0, 0.0}, 0.0, {}, 1);
  plan.Stand(1.0);
  plan.Turn(360.0);
  EXPECT_THROW(plan.Finish(plan.moving_s()), InternalError);
}

TEST(RobotPlan, ShakesWhileItMovesAndNotWhileItStands) {
  RobotPlan plan({0.0, 0.0}, 0.0, {}, 1);
  plan.Stand(2.0);
  plan.Ride({{2.0, 0.0}});
  plan.Stand(2.0);
  const RobotRide ride = plan.Finish(plan.moving_s() + 4.0);
  const auto height = [&](double t) { return ride.camera.T_world_camera(t).translation.z(); };
  double standing = 0.0;
  double moving = 0.0;
  for (int i = 0; i < 100; ++i) {
    standing = std::max(standing, std::abs(height(0.1 + 0.015 * i) - 0.4));
    moving = std::max(moving, std::abs(height(4.0 + 0.03 * i) - 0.4));
  }
  EXPECT_EQ(standing, 0.0);
  EXPECT_GT(moving, 5e-5);
  EXPECT_LT(moving, 2e-3);
}

TEST(RobotPlan, TakesAnotherWayWithAnotherSeedAndTheSameWithTheSame) {
  const auto end = [](std::uint64_t seed) {
    RobotPlan plan({0.0, 0.0}, 0.0, {.place_noise_m = 0.02}, seed);
    plan.Stand(1.0);
    plan.Ride({{1.0, 1.0}});
    return PlaceAt(plan.Finish(20.0), 20.0);
  };
  EXPECT_EQ(end(1), end(1));
  EXPECT_NE(end(1), end(2));
  EXPECT_LT((end(2) - Eigen::Vector2d(1.0, 1.0)).norm(), 0.03);
}

}  // namespace
}  // namespace cslam
