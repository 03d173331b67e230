// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// The whole system on the simulated room, small: accuracy bars for both executions.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "e2e_support.h"

namespace cslam {
namespace {

constexpr int kNumFrames = 120;

const test::TestFrames& NoisyFrames() {
  static const auto frames = test::MakeTestFrames(
      {.width = 320, .height = 240, .num_frames = kNumFrames, .noise = SensorNoise::kKinect});
  return frames;
}

const test::TestFrames& CleanFrames() {
  static const auto frames = test::MakeTestFrames(
      {.width = 320, .height = 240, .num_frames = kNumFrames, .noise = SensorNoise::kOff});
  return frames;
}

const RunResult& InlineNoisyRun() {
  static const RunResult result = test::RunSlam(NoisyFrames(), Execution::kInline);
  return result;
}

void ExpectAllTracked(const RunResult& result) {
  EXPECT_EQ(result.frames.size(), static_cast<std::size_t>(kNumFrames));
  EXPECT_EQ(FinalTrajectory(result).size(), static_cast<std::size_t>(kNumFrames));
  EXPECT_EQ(result.frames_dropped, 0U);
}

TEST(SimulatedRoom, IsTrackedToMillimetresWithoutSensorNoise) {
  const RunResult result = test::RunSlam(CleanFrames(), Execution::kInline);
  ExpectAllTracked(result);
  const double ate_m = test::FinalAte(CleanFrames().truth, result);
  RecordProperty("ate_mm", std::to_string(1e3 * ate_m));
  EXPECT_LT(ate_m, 0.005);
}

TEST(SimulatedRoom, IsTrackedToACentimetreWithSensorNoise) {
  ExpectAllTracked(InlineNoisyRun());
  const double ate_m = test::FinalAte(NoisyFrames().truth, InlineNoisyRun());
  RecordProperty("ate_mm", std::to_string(1e3 * ate_m));
  EXPECT_LT(ate_m, 0.010);
  const auto live = EvaluateAte(NoisyFrames().truth, LiveTrajectory(InlineNoisyRun()));
  EXPECT_LT(live.statistics_m.rmse, 0.015);
}

TEST(SimulatedRoom, ThreadedIsAboutAsAccurateAsInline) {
  const double inline_m = test::FinalAte(NoisyFrames().truth, InlineNoisyRun());
  std::array<double, 3> ates_m{};  // threads take turns as they like: one run may be unlucky
  for (double& ate_m : ates_m) {
    const RunResult result = test::RunSlam(NoisyFrames(), Execution::kThreaded);
    ExpectAllTracked(result);
    ate_m = test::FinalAte(NoisyFrames().truth, result);
  }
  std::sort(ates_m.begin(), ates_m.end());
  const double threaded_m = ates_m[1];
  RecordProperty("ate_mm", std::to_string(1e3 * threaded_m));
  EXPECT_LT(threaded_m, 1.15 * inline_m + 0.002);
}

TEST(SimulatedRoom, HoldsTheMapPoints) {
  // The first camera is the map's world: points must lie inside the room (6 x 5 x 2.7 m).
  const MapView& map = InlineNoisyRun().snapshot->map;
  const Se3& T_room_world = NoisyFrames().truth.front().T_world_camera;
  std::size_t outside = 0;
  for (std::uint32_t i = 0; i < map.num_point_ids(); ++i) {
    const MapPoint* point = map.FindPoint(PointId(i));
    if (point == nullptr) continue;
    const Eigen::Vector3d p_room = T_room_world * point->p_world;
    const Eigen::Vector3d size(6.0, 5.0, 2.7);
    const double slack_m = 0.1;
    if ((p_room.array() < -slack_m).any() || ((p_room - size).array() > slack_m).any()) ++outside;
  }
  EXPECT_GT(map.num_points(), 500U);
  EXPECT_LT(static_cast<double>(outside), 0.06 * static_cast<double>(map.num_points()));
}

}  // namespace
}  // namespace cslam
