// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// Inline runs are equal to the last bit, whatever ran in the same process before.
#include <gtest/gtest.h>

#include <bit>

#include "e2e_support.h"

namespace cslam {
namespace {

const test::TestFrames& Frames() {
  static const auto frames =
      test::MakeTestFrames({.width = 320, .height = 240, .fps = 15.0, .num_frames = 60});
  return frames;
}

// Every bit of the numbers pushed, in order.
class Bits {
 public:
  void Push(double value) { bits_.push_back(std::bit_cast<std::uint64_t>(value)); }
  void Push(const Eigen::Vector3d& v) {
    for (const double value : v)
      Push(value);
  }
  void Push(const Se3& T) {
    Push(T.translation);
    for (const double value : T.rotation.coeffs())
      Push(value);
  }
  bool operator==(const Bits&) const = default;
  std::size_t size() const { return bits_.size(); }

 private:
  std::vector<std::uint64_t> bits_;
};

Bits BitsOf(const Trajectory& trajectory) {
  Bits bits;
  for (const StampedPose& pose : trajectory)
    bits.Push(pose.T_world_camera);
  return bits;
}

Bits BitsOf(const MapView& map) {
  Bits bits;
  for (const KeyframeId id : map.Keyframes()) {
    bits.Push(static_cast<double>(id.value()));
    bits.Push(map.FindKeyframe(id)->T_world_camera);
    for (const PointId point : map.FindKeyframe(id)->points)
      bits.Push(static_cast<double>(point.value()));
  }
  for (std::uint32_t i = 0; i < map.num_point_ids(); ++i) {
    if (const MapPoint* point = map.FindPoint(PointId(i))) bits.Push(point->p_world);
  }
  return bits;
}

TEST(InlineRun, GivesTheSameBitsEveryTime) {
  const RunResult first = test::RunSlam(Frames(), Execution::kInline);
  const RunResult second = test::RunSlam(Frames(), Execution::kInline);
  EXPECT_EQ(FinalTrajectory(first).size(), Frames().frames.size());
  EXPECT_EQ(BitsOf(FinalTrajectory(first)), BitsOf(FinalTrajectory(second)));
  EXPECT_EQ(BitsOf(LiveTrajectory(first)), BitsOf(LiveTrajectory(second)));
  EXPECT_EQ(BitsOf(first.snapshot->map), BitsOf(second.snapshot->map));
}

TEST(InlineRun, IsNotTouchedByAThreadedRunBefore) {
  const RunResult first = test::RunSlam(Frames(), Execution::kInline);
  test::RunSlam(Frames(), Execution::kThreaded);
  const RunResult second = test::RunSlam(Frames(), Execution::kInline);
  EXPECT_EQ(BitsOf(FinalTrajectory(first)), BitsOf(FinalTrajectory(second)));
  EXPECT_EQ(BitsOf(first.snapshot->map), BitsOf(second.snapshot->map));
}

TEST(InlineRun, FeedAndTrackGiveTheSameBits) {
  Slam slam(Frames().camera, test::CheckedOptions(), Execution::kInline);
  for (const auto& frame : Frames().frames)
    slam.Track(frame);
  const RunResult fed = test::RunSlam(Frames(), Execution::kInline);
  EXPECT_EQ(BitsOf(FinalTrajectory(slam.Finish())), BitsOf(FinalTrajectory(fed)));
}

}  // namespace
}  // namespace cslam
