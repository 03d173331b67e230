// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/handheld_motion.h"

#include <gtest/gtest.h>

#include <numbers>

namespace cslam {
namespace {

constexpr double kStepS = 1.0 / 30.0;
constexpr double kDegree = std::numbers::pi / 180.0;
const PathKey kHome{{1.0, 2.0, 1.4}, 0.5 * std::numbers::pi, -0.15};

struct Journey {
  double length_m = 0.0;
  double turn_deg_per_s = 0.0;
  Eigen::Vector3d extent_m = Eigen::Vector3d::Zero();
  double fastest_m_s = 0.0;
  double fastest_deg_per_s = 0.0;
};

Journey Measure(const CameraMotion& motion) {
  Journey journey;
  Eigen::Vector3d low = motion.T_world_camera(0.0).translation;
  Eigen::Vector3d high = low;
  for (double t = 0.0; t + kStepS <= motion.duration_s; t += kStepS) {
    const Se3 next = motion.T_world_camera(t + kStepS);
    const PoseDifference step = Difference(motion.T_world_camera(t), next);
    journey.length_m += step.distance_m;
    journey.turn_deg_per_s += step.angle_rad / kDegree / motion.duration_s;
    journey.fastest_m_s = std::max(journey.fastest_m_s, step.distance_m / kStepS);
    journey.fastest_deg_per_s =
        std::max(journey.fastest_deg_per_s, step.angle_rad / kDegree / kStepS);
    low = low.cwiseMin(next.translation);
    high = high.cwiseMax(next.translation);
  }
  journey.extent_m = high - low;
  return journey;
}

TEST(HandheldMotion, PassesNearItsViewsAndRestsAtTheEndsWithoutJumpsInSpeed) {
  const HandTremor still{.position_m = 0.0, .rotation_rad = 0.0, .seed = 1};
  const CameraMotion motion = HandheldMotion({{0.0, {{0.0, 0.0, 1.0}, 0.0, 0.0}},
                                              {3.0, {{3.0, 0.0, 1.0}, 0.0, 0.0}},
                                              {6.0, {{3.0, 3.0, 1.0}, 1.5, 0.0}}},
                                             0.5, still);
  EXPECT_DOUBLE_EQ(motion.duration_s, 6.0);
  EXPECT_NEAR((motion.T_world_camera(1.5).translation - Eigen::Vector3d(1.5, 0.0, 1.0)).norm(), 0.0,
              1e-9);
  EXPECT_NEAR((motion.T_world_camera(3.0).translation - Eigen::Vector3d(3.0, 0.0, 1.0)).norm(), 0.0,
              0.15);
  EXPECT_NEAR((motion.T_world_camera(7.0).translation - Eigen::Vector3d(3.0, 3.0, 1.0)).norm(), 0.0,
              1e-9);
  Eigen::Vector3d previous = Eigen::Vector3d::Zero();
  for (double t = -1.0; t < 7.0; t += 0.01) {
    const Eigen::Vector3d step =
        motion.T_world_camera(t + 0.01).translation - motion.T_world_camera(t).translation;
    EXPECT_LT((step - previous).norm(), 5e-4) << "at " << t;  // 5 m/s^2 over 10 ms
    previous = step;
  }
}

TEST(StaticHand, TremblesAsFarAndAsFastAsTheRecording) {
  const Journey journey = Measure(StaticHand(kHome, 25.0, 1));
  EXPECT_NEAR(journey.length_m, 0.3, 0.1);
  EXPECT_NEAR(journey.turn_deg_per_s, 1.4, 0.5);
  EXPECT_LT(journey.extent_m.maxCoeff(), 0.03);
}

TEST(XyzHand, CoversItsCubeAtTheRecordingsSpeed) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Journey journey = Measure(XyzHand(kHome, 28.0, 0.207, seed));
    EXPECT_NEAR(journey.length_m, 5.8, 0.35);
    EXPECT_NEAR(journey.extent_m.x(), 0.75, 0.15);
    EXPECT_NEAR(journey.extent_m.y(), 0.7, 0.15);
    EXPECT_NEAR(journey.extent_m.z(), 0.6, 0.15);
    EXPECT_NEAR(journey.turn_deg_per_s, 3.5, 2.5);
    EXPECT_LT(journey.fastest_m_s, 0.5);
  }
}

TEST(RpyHand, TurnsNearlyInPlaceAtTheRecordingsSpeed) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Journey journey = Measure(RpyHand(kHome, 30.0, seed));
    EXPECT_NEAR(journey.turn_deg_per_s, 21.0, 2.0);
    EXPECT_NEAR(journey.length_m, 2.7, 0.6);
    EXPECT_LT(journey.extent_m.maxCoeff(), 0.3);
    EXPECT_LT(journey.fastest_deg_per_s, 60.0);
  }
}

TEST(HalfsphereHand, StaysOnItsSphereAtTheRecordingsSpeed) {
  const CameraMotion motion = HalfsphereHand(kHome, 35.0, 1);
  const Journey journey = Measure(motion);
  EXPECT_NEAR(journey.length_m, 7.7, 0.5);
  EXPECT_NEAR(journey.extent_m.x(), 0.95, 0.15);
  EXPECT_NEAR(journey.turn_deg_per_s, 17.0, 4.0);
  EXPECT_LT(journey.fastest_m_s, 0.5);
  EXPECT_LT(journey.fastest_deg_per_s, 60.0);
}

TEST(HandheldMotion, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const Se3 one = XyzHand(kHome, 28.0, 0.207, 1).T_world_camera(10.0);
  EXPECT_EQ(one.Matrix(), XyzHand(kHome, 28.0, 0.207, 1).T_world_camera(10.0).Matrix());
  EXPECT_GT(Difference(one, XyzHand(kHome, 28.0, 0.207, 2).T_world_camera(10.0)).angle_rad, 1e-4);
}

}  // namespace
}  // namespace cslam
