// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/pipeline/test_slam.h"
#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace cslam {
namespace {

using test::Frames;
using test::NameOf;
using test::Renamed;
using test::SmallOptions;
using testing::HasSubstr;

constexpr std::size_t kNumFirst = 10;  // frames of the first session

// As a map file gives it back.
Map Copy(const MapView& view) {
  MapContents contents;
  contents.level_scales = LevelScales(SmallOptions().tracking.orb);
  for (std::size_t i = 0; i < view.num_keyframe_ids(); ++i)
    contents.keyframes.push_back(view.KeyframeSlot(i));
  for (std::size_t i = 0; i < view.num_point_ids(); ++i)
    contents.points.push_back(view.PointSlot(i));
  contents.loops = view.loops();
  contents.sessions = view.sessions();
  return Map(std::move(contents));
}

// What a run over the first frames left behind.
const Map& FirstMap() {
  static const Map map = [] {
    Slam slam(Frames().camera, SmallOptions(), Execution::kInline);
    for (std::size_t i = 0; i < kNumFirst; ++i)
      slam.Track(Frames().frames[i]);
    return Copy(slam.Finish().snapshot->map);
  }();
  return map;
}

class UpdateRecorder : public OutputSink {
 public:
  void OnMap(const MapUpdate& update) override { steps.push_back(update.step); }
  std::vector<MapUpdate::Step> steps;
};

class ContinueTest : public testing::TestWithParam<Execution> {
 protected:
  explicit ContinueTest(const SlamOptions& options = SmallOptions())
      : recorder_(std::make_shared<UpdateRecorder>()),
        slam_(Frames().camera, options, GetParam(), {recorder_}) {}

  // Later and later, whichever of the frames it shows.
  TrackingResult Show(std::size_t i) {
    const Stamp stamp = Stamp{0} + std::int64_t{100'000'000} * next_;
    return slam_.Track(Renamed(*Frames().frames[i], next_++, stamp));
  }

  // Threaded, the place becomes known some frames later.
  TrackingResult ShowUntilTracked() {
    TrackingResult result;
    for (int tries = 0; tries < 1000 && !result.T_world_camera; ++tries)
      result = Show(kNumFirst);
    return result;
  }

  static Se3 Truth(std::size_t i) {
    return Frames().truth[0].T_world_camera.Inverse() * Frames().truth[i].T_world_camera;
  }

  std::shared_ptr<UpdateRecorder> recorder_;
  Slam slam_;
  std::uint32_t next_ = 0;
};

INSTANTIATE_TEST_SUITE_P(Executions, ContinueTest,
                         testing::Values(Execution::kInline, Execution::kThreaded), NameOf);

TEST_P(ContinueTest, GoesOnInTheWorldOfTheEarlierMap) {
  const std::size_t num_before = FirstMap().num_keyframe_ids();
  slam_.Continue(Copy(FirstMap()));
  const TrackingResult found = ShowUntilTracked();
  ASSERT_TRUE(found.T_world_camera) << found.reason;
  EXPECT_EQ(found.map, MapId(0));
  EXPECT_LT(Difference(Truth(kNumFirst), *found.T_world_camera).distance_m, 0.05);
  for (std::size_t i = kNumFirst + 1; i < Frames().frames.size(); ++i)
    EXPECT_EQ(Show(i).map, MapId(0));
  const RunResult& result = slam_.Finish();
  const MapView& map = result.snapshot->map;
  EXPECT_GT(map.num_keyframe_ids(), num_before);
  ASSERT_EQ(map.sessions().size(), 2U);
  EXPECT_EQ(map.sessions()[1], KeyframeId(static_cast<std::uint32_t>(num_before)));
  EXPECT_FALSE(KeyframeTrajectory(result).empty());
  EXPECT_LT(KeyframeTrajectory(result).size(), map.num_keyframes()) << "those of this run only";
}

TEST_P(ContinueTest, LocalisesWithoutChangingTheMap) {
  slam_.SetMode(TrackingMode::kLocaliseOnly);
  slam_.Continue(Copy(FirstMap()));
  ASSERT_TRUE(ShowUntilTracked().T_world_camera);
  for (std::size_t i = kNumFirst + 1; i < kNumFirst + 5; ++i) {
    const TrackingResult result = Show(i);
    ASSERT_TRUE(result.T_world_camera) << result.reason;
    EXPECT_EQ(result.keyframe_reason, KeyframeReason::kLocaliseOnly);
    EXPECT_LT(Difference(Truth(i), *result.T_world_camera).distance_m, 0.05);
  }
  const RunResult& result = slam_.Finish();
  EXPECT_EQ(recorder_->steps, std::vector{MapUpdate::Step::kContinued});
  EXPECT_EQ(result.snapshot->map.num_keyframe_ids(), FirstMap().num_keyframe_ids());
  EXPECT_TRUE(KeyframeTrajectory(result).empty());
  EXPECT_GE(FinalTrajectory(result).size(), 5U);
}

TEST_P(ContinueTest, ModeChangesWithTheNextFrame) {
  for (std::size_t i = 0; i < 5; ++i)
    Show(i);
  slam_.SetMode(TrackingMode::kLocaliseOnly);
  for (std::size_t i = 5; i < 11; ++i)
    EXPECT_EQ(Show(i).keyframe_reason, KeyframeReason::kLocaliseOnly);
  slam_.SetMode(TrackingMode::kMapping);
  bool is_mapped = false;
  for (std::size_t i = 11; i < 17; ++i)
    is_mapped = IsProposal(Show(i).keyframe_reason) || is_mapped;
  EXPECT_TRUE(is_mapped);
}

TEST_P(ContinueTest, LocalisesNothingWithoutAMap) {
  slam_.SetMode(TrackingMode::kLocaliseOnly);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_FALSE(Show(i).T_world_camera);
  EXPECT_EQ(slam_.Finish().snapshot->map.num_keyframes(), 0U);
}

TEST_P(ContinueTest, RefusesAMapOfAnotherPyramid) {
  const std::string message = MessageOf([&] {
    slam_.Continue(Map(std::vector<double>{1.0, 1.5}));
    Show(0);
  });
  EXPECT_THAT(message, HasSubstr("another image pyramid of 2 levels"));
}

SlamOptions ImpatientOptions() {
  SlamOptions options = SmallOptions();
  options.tracking.recently_lost_s = 0.3;
  return options;
}

class ImpatientContinueTest : public ContinueTest {
 protected:
  ImpatientContinueTest() : ContinueTest(ImpatientOptions()) {}
};
INSTANTIATE_TEST_SUITE_P(Executions, ImpatientContinueTest,
                         testing::Values(Execution::kInline, Execution::kThreaded), NameOf);

TEST_P(ImpatientContinueTest, StartsANewMapWhereTheEarlierOneIsNotFound) {
  slam_.Continue(Copy(FirstMap()));
  std::vector<TrackingResult> results;
  for (int i = 0; i < 6; ++i) {
    RgbdFrame frame = *Frames().frames[0];
    cv::Mat mirrored;  // no place looks as it did
    cv::flip(frame.gray, mirrored, 1);
    frame.gray = mirrored;
    frame.stamp = Stamp{0} + std::int64_t{100'000'000} * i;
    results.push_back(slam_.Track(std::make_shared<const RgbdFrame>(std::move(frame))));
  }
  EXPECT_FALSE(results[0].T_world_camera) << "it is searched for a while";
  ASSERT_TRUE(results[5].T_world_camera) << results[5].reason;
  EXPECT_EQ(results[5].map, MapId(1));
  EXPECT_GE(results[5].reference.index(), FirstMap().num_keyframe_ids());
}

}  // namespace
}  // namespace cslam
