// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/pipeline/run_result.h"

#include "cslam/map/test_map.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

Se3 At(double x) {
  return {Eigen::Quaterniond::Identity(), {x, 0.0, 0.0}};
}

FrameRecord Tracked(std::uint32_t id, MapId map, KeyframeId reference, double x_from_reference,
                    double live_x) {
  FrameRecord record;
  record.frame = FrameId(id);
  record.stamp = Stamp{1000 * static_cast<std::int64_t>(id)};
  record.state = TrackingState::kTracking;
  record.map = map;
  record.reference = reference;
  record.T_reference_camera = At(x_from_reference);
  record.T_world_camera = At(live_x);
  return record;
}

// Keyframes 0 and 2 of map 0, 1 culled into 0, 3 of map 1; three frames of map 0, one of map 1.
RunResult MakeResult() {
  Map map(test::kLevelScales);
  map.AddKeyframe(test::MakeKeyframe(0, 5, 0.0));
  map.AddKeyframe(test::MakeKeyframe(1, 5, 1.0, KeyframeId(0)));
  map.AddKeyframe(test::MakeKeyframe(2, 5, 2.0, KeyframeId(1)));
  map.AddKeyframe(test::MakeKeyframe(3, 5, 9.0, {}, MapId(1)));
  map.CullKeyframe(KeyframeId(1));
  map.SetPose(KeyframeId(0), At(10.0));
  auto snapshot = std::make_shared<MapSnapshot>();
  snapshot->map = map.Snapshot();

  RunResult result;
  result.snapshot = std::move(snapshot);
  result.frames.push_back(Tracked(0, MapId(0), KeyframeId(0), 0.0, 0.1));
  result.frames.push_back(Tracked(1, MapId(0), KeyframeId(1), 0.5, 0.2));
  result.frames.push_back(Tracked(2, MapId(0), KeyframeId(2), 0.5, 0.3));
  result.frames.push_back(Tracked(3, MapId(0), KeyframeId(2), 0.5, 0.4));
  result.frames.back().state = TrackingState::kRecentlyLost;
  result.frames.push_back(Tracked(4, MapId(1), KeyframeId(3), 0.5, 0.5));
  return result;
}

std::vector<double> Xs(const Trajectory& trajectory) {
  std::vector<double> xs;
  for (const StampedPose& pose : trajectory)
    xs.push_back(pose.T_world_camera.translation.x());
  return xs;
}

TEST(FinalTrajectory, FollowsCorrectedAndCulledReferences) {
  EXPECT_EQ(Xs(FinalTrajectory(MakeResult())), (std::vector{10.0, 11.5, 2.5}));
}

TEST(FinalTrajectory, LeavesOutReferencesThatAreGone) {
  RunResult result = MakeResult();
  result.frames[0].reference = KeyframeId(77);
  EXPECT_EQ(FinalTrajectory(result).size(), 2U);
}

TEST(LiveTrajectory, IsWhatWasFirstPublished) {
  EXPECT_EQ(Xs(LiveTrajectory(MakeResult())), (std::vector{0.1, 0.2, 0.3}));
}

TEST(KeyframeTrajectory, HoldsTheLivingKeyframesOfTheLargestMap) {
  EXPECT_EQ(Xs(KeyframeTrajectory(MakeResult())), (std::vector{10.0, 2.0}));
}

TEST(LargestMap, CountsTrackedFramesOnlyAndPrefersTheFirstOfEquals) {
  RunResult result = MakeResult();
  EXPECT_EQ(LargestMap(result), MapId(0));
  result.frames[0].state = result.frames[1].state = TrackingState::kLost;
  EXPECT_EQ(LargestMap(result), MapId(0));
  result.frames[2].state = TrackingState::kLost;
  EXPECT_EQ(LargestMap(result), MapId(1));
}

TEST(MakeRecord, KeepsWhatTheTrajectoriesNeed) {
  TrackingResult tracked;
  tracked.frame = FrameId(4);
  tracked.stamp = Stamp{5};
  tracked.state = TrackingState::kTracking;
  tracked.map = MapId(2);
  tracked.T_world_camera = At(3.0);
  tracked.reference = KeyframeId(6);
  tracked.T_reference_camera = At(1.0);
  const FrameRecord record = MakeRecord(tracked);
  EXPECT_EQ(record.frame, FrameId(4));
  EXPECT_EQ(record.stamp, Stamp{5});
  EXPECT_EQ(record.map, MapId(2));
  EXPECT_EQ(record.reference, KeyframeId(6));
  EXPECT_EQ(record.T_world_camera.translation.x(), 3.0);
  EXPECT_EQ(record.T_reference_camera.translation.x(), 1.0);
}

}  // namespace
}  // namespace cslam
