// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/pipeline/test_slam.h"
#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <limits>
#include <stdexcept>

namespace cslam {
namespace {

using test::Frames;
using test::NameOf;
using test::Renamed;
using test::SmallOptions;
using testing::HasSubstr;

// Writes down what it is told. Read it after Finish().
class Recorder : public OutputSink {
 public:
  void OnFrame(const TrackingResult& result) override { frames.push_back(result); }
  void OnMap(const MapUpdate& update) override { updates.push_back(update); }
  void OnFinish(const RunResult& result) override {
    ++num_finishes;
    frames_at_finish = result.frames.size();
  }
  std::vector<TrackingResult> frames;
  std::vector<MapUpdate> updates;
  int num_finishes = 0;
  std::size_t frames_at_finish = 0;
};

class ThrowingSink : public OutputSink {
 public:
  enum class When { kFrame, kMap, kFinish };
  explicit ThrowingSink(When when) : when_(when) {}
  void OnFrame(const TrackingResult& result) override {
    if (result.frame == FrameId(3)) ThrowAt(When::kFrame);
  }
  void OnMap(const MapUpdate& /*update*/) override { ThrowAt(When::kMap); }
  void OnFinish(const RunResult& /*result*/) override { ThrowAt(When::kFinish); }

 private:
  void ThrowAt(When when) const {
    if (when == when_) throw std::runtime_error("the sink is full");
  }
  When when_;
};

class SlamTest : public testing::TestWithParam<Execution> {
 protected:
  SlamTest() : recorder_(std::make_shared<Recorder>()) {}
  std::unique_ptr<Slam> MakeSlam(FeedPolicy policy = FeedPolicy::kWait) const {
    return std::make_unique<Slam>(Frames().camera, SmallOptions(), GetParam(),
                                  std::vector<std::shared_ptr<OutputSink>>{recorder_}, policy);
  }
  std::unique_ptr<Slam> MakeSlamWith(ThrowingSink::When when) const {
    return std::make_unique<Slam>(
        Frames().camera, SmallOptions(), GetParam(),
        std::vector<std::shared_ptr<OutputSink>>{std::make_shared<ThrowingSink>(when)});
  }
  const std::shared_ptr<Recorder> recorder_;
};

INSTANTIATE_TEST_SUITE_P(Executions, SlamTest,
                         testing::Values(Execution::kInline, Execution::kThreaded), NameOf);

TEST_P(SlamTest, GivesEveryFrameToTheSinksInOrder) {
  const auto slam = MakeSlam();
  for (const auto& frame : Frames().frames)
    slam->Feed(frame);
  const RunResult& result = slam->Finish();
  ASSERT_EQ(recorder_->frames.size(), Frames().frames.size());
  ASSERT_EQ(result.frames.size(), Frames().frames.size());
  for (std::size_t i = 0; i < Frames().frames.size(); ++i) {
    EXPECT_EQ(recorder_->frames[i].frame, Frames().frames[i]->id);
    EXPECT_EQ(result.frames[i].frame, Frames().frames[i]->id);
    EXPECT_EQ(result.frames[i].stamp, Frames().frames[i]->stamp);
    EXPECT_EQ(result.frames[i].state, TrackingState::kTracking) << recorder_->frames[i].reason;
  }
  EXPECT_EQ(recorder_->num_finishes, 1);
  EXPECT_EQ(recorder_->frames_at_finish, Frames().frames.size());
}

TEST_P(SlamTest, PublishesEveryKeyframeBeforeAndAfterRefining) {
  const auto slam = MakeSlam();
  for (const auto& frame : Frames().frames)
    slam->Feed(frame);
  slam->Finish();
  const auto& updates = recorder_->updates;
  ASSERT_GE(updates.size(), 4U);
  ASSERT_EQ(updates.size() % 2, 0U);
  for (std::size_t i = 0; i < updates.size(); i += 2) {
    EXPECT_EQ(updates[i].step, MapUpdate::Step::kInserted);
    EXPECT_EQ(updates[i + 1].step, MapUpdate::Step::kRefined);
    EXPECT_EQ(updates[i].keyframe, updates[i + 1].keyframe);
    EXPECT_EQ(updates[i].snapshot->revision, i + 1);
    EXPECT_EQ(updates[i + 1].snapshot->revision, i + 2);
  }
}

TEST_P(SlamTest, ResultHoldsTheNewestMapAndAllTrajectories) {
  const auto slam = MakeSlam();
  EXPECT_EQ(slam->map(), nullptr);
  for (const auto& frame : Frames().frames)
    slam->Feed(frame);
  const RunResult& result = slam->Finish();
  EXPECT_EQ(result.snapshot, recorder_->updates.back().snapshot);
  EXPECT_EQ(slam->map(), result.snapshot);
  EXPECT_EQ(FinalTrajectory(result).size(), Frames().frames.size());
  EXPECT_EQ(LiveTrajectory(result).size(), Frames().frames.size());
  EXPECT_EQ(KeyframeTrajectory(result).size(), result.snapshot->map.num_keyframes());
  EXPECT_EQ(&slam->Finish(), &result) << "a second Finish() changes nothing";
  EXPECT_EQ(recorder_->num_finishes, 1);
}

TEST_P(SlamTest, TrackReturnsThePoseOfThatFrame) {
  const auto slam = MakeSlam();
  for (const auto& frame : Frames().frames) {
    const TrackingResult result = slam->Track(frame);
    EXPECT_EQ(result.frame, frame->id);
    ASSERT_TRUE(result.T_world_camera.has_value()) << result.reason;
  }
  slam->Finish();
  EXPECT_EQ(recorder_->frames.size(), Frames().frames.size());
  EXPECT_EQ(recorder_->frames.front().T_world_camera->translation, Eigen::Vector3d::Zero());
}

TEST_P(SlamTest, FinishWithoutFramesGivesAnEmptyResult) {
  const RunResult& result = MakeSlam()->Finish();
  EXPECT_EQ(recorder_->num_finishes, 1);
  static_cast<void>(result);
  const auto slam = MakeSlam();
  EXPECT_TRUE(FinalTrajectory(slam->Finish()).empty());
  EXPECT_TRUE(KeyframeTrajectory(slam->Finish()).empty());
  EXPECT_FALSE(LargestMap(slam->Finish()).valid());
}

TEST_P(SlamTest, GoesAwayWithoutFinish) {
  const auto slam = MakeSlam();
  for (std::size_t i = 0; i < 5; ++i)
    slam->Feed(Frames().frames[i]);
}

TEST_P(SlamTest, StartsAnewAfterReset) {
  const auto slam = MakeSlam();
  for (std::size_t i = 0; i < 6; ++i)
    slam->Feed(Frames().frames[i]);
  slam->Reset();
  const std::uint32_t first_id = 100;
  for (std::size_t i = 0; i < 6; ++i) {
    const RgbdFrame& frame = *Frames().frames[i];
    slam->Feed(Renamed(frame, first_id + static_cast<std::uint32_t>(i), frame.stamp));
  }
  const RunResult& result = slam->Finish();
  ASSERT_EQ(result.frames.size(), 6U) << "frames before the reset are forgotten";
  for (const FrameRecord& frame : result.frames) {
    EXPECT_GE(frame.frame.value(), first_id);
    EXPECT_EQ(frame.state, TrackingState::kTracking);
    EXPECT_EQ(frame.map, MapId(1)) << "map ids are not used twice";
  }
  EXPECT_EQ(FinalTrajectory(result).size(), 6U);
  for (const KeyframeId id : result.snapshot->map.Keyframes())
    EXPECT_EQ(result.snapshot->map.FindKeyframe(id)->map, MapId(1));
}

TEST_P(SlamTest, ResetAtTheVeryStartAndTwiceIsFine) {
  const auto slam = MakeSlam();
  slam->Reset();
  slam->Reset();
  EXPECT_TRUE(slam->Track(Frames().frames[0]).T_world_camera.has_value());
  slam->Reset();
  EXPECT_TRUE(slam->Finish().frames.empty());
  EXPECT_EQ(slam->map(), nullptr);
}

TEST_P(SlamTest, ResetIsNotLostWhereFramesAreDropped) {
  const auto slam = MakeSlam(FeedPolicy::kDropOldest);
  slam->Track(Frames().frames[0]);
  for (std::size_t i = 1; i < 6; ++i)
    slam->Feed(Frames().frames[i]);
  slam->Reset();
  const std::uint32_t first_id = 100;
  for (std::uint32_t i = 0; i < 6; ++i)
    slam->Feed(Renamed(*Frames().frames[i], first_id + i, Frames().frames[i]->stamp));
  const RunResult& result = slam->Finish();
  ASSERT_FALSE(result.frames.empty());
  EXPECT_GE(result.frames.front().frame.value(), first_id) << "those before are forgotten";
  EXPECT_EQ(result.frames.back().map, MapId(1));
}

TEST_P(SlamTest, ExceptionOfASinkReachesTheCaller) {
  for (const auto when :
       {ThrowingSink::When::kFrame, ThrowingSink::When::kMap, ThrowingSink::When::kFinish}) {
    const auto slam = MakeSlamWith(when);
    const std::string message = MessageOf([&] {
      for (const auto& frame : Frames().frames)
        slam->Feed(frame);
      slam->Finish();
    });
    EXPECT_EQ(message, "the sink is full");
  }
}

TEST_P(SlamTest, ExceptionOfASinkReachesWhoTracks) {
  const auto slam = MakeSlamWith(ThrowingSink::When::kFrame);
  const std::string message = MessageOf([&] {
    for (const auto& frame : Frames().frames)
      slam->Track(frame);
    slam->Finish();
  });
  EXPECT_EQ(message, "the sink is full");
}

TEST_P(SlamTest, StaysUsableForQuestionsAfterAFailure) {
  const auto slam = MakeSlamWith(ThrowingSink::When::kFinish);
  for (std::size_t i = 0; i < 3; ++i)
    slam->Feed(Frames().frames[i]);
  EXPECT_THROW(slam->Finish(), std::runtime_error);
  EXPECT_NE(slam->map(), nullptr);
}

TEST_P(SlamTest, RefusesFramesThatDoNotFitTheCamera) {
  const auto slam = MakeSlam();
  RgbdFrame frame = *Frames().frames[0];
  frame.gray = cv::Mat(480, 640, CV_8UC1, cv::Scalar(0));
  const auto feed = [&] { slam->Feed(std::make_shared<const RgbdFrame>(frame)); };
  EXPECT_THAT(MessageOf(feed), HasSubstr("grey image is 640x480"));
  EXPECT_THROW(feed(), Error);
  frame = *Frames().frames[0];
  frame.gray = cv::Mat(240, 320, CV_8UC3, cv::Scalar(0));
  EXPECT_THROW(feed(), Error);
  frame = *Frames().frames[0];
  frame.depth_m = cv::Mat(240, 320, CV_16UC1, cv::Scalar(0));
  EXPECT_THAT(MessageOf(feed), HasSubstr("depth image"));
  frame.depth_m = cv::Mat();
  EXPECT_THROW(feed(), Error);
  EXPECT_TRUE(slam->Track(Frames().frames[0]).T_world_camera) << "none of them did harm";
}

TEST_P(SlamTest, RefusesStampsThatDoNotIncrease) {
  const auto slam = MakeSlam();
  slam->Feed(Frames().frames[1]);
  EXPECT_THAT(MessageOf([&] { slam->Feed(Frames().frames[1]); }), HasSubstr("does not come after"));
  EXPECT_THROW(slam->Track(Frames().frames[0]), Error);
  slam->Feed(Frames().frames[2]);
  EXPECT_EQ(slam->Finish().frames.size(), 2U);
}

TEST_P(SlamTest, RefusesUnusableCameraAndOptions) {
  Camera camera = Frames().camera;
  camera.fx = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Slam(camera, SmallOptions(), GetParam()), Error);
  SlamOptions options = SmallOptions();
  options.tracking.orb.num_features = -1;
  EXPECT_THAT(MessageOf([&] { Slam(Frames().camera, options, GetParam()); }),
              HasSubstr("num_features"));
}

TEST_P(SlamTest, FrameAfterFinishIsAnInternalError) {
  const auto slam = MakeSlam();
  slam->Finish();
  EXPECT_THROW(slam->Feed(Frames().frames[0]), InternalError);
}

TEST(ThreadedSlam, DropsAndCountsTheOldestWhenFedTooFast) {
  const auto recorder = std::make_shared<Recorder>();
  Slam slam(Frames().camera, SmallOptions(), Execution::kThreaded, {recorder},
            FeedPolicy::kDropOldest);
  const int rounds = 20;
  std::size_t num_fed = 0;
  Stamp stamp{0};
  for (int round = 0; round < rounds; ++round) {
    for (const auto& frame : Frames().frames) {
      slam.Feed(Renamed(*frame, static_cast<std::uint32_t>(num_fed++), stamp = stamp + 1'000'000));
    }
  }
  const RunResult& result = slam.Finish();
  EXPECT_GT(result.frames_dropped, 0U) << "feeding costs microseconds, tracking milliseconds";
  EXPECT_EQ(result.frames.size() + result.frames_dropped, num_fed);
  EXPECT_EQ(recorder->frames.size(), result.frames.size());
  EXPECT_EQ(result.frames.back().frame.value(), num_fed - 1) << "the newest frame is kept";
}

TEST(ThreadedSlam, DropsNothingWhenFedTooFastButToldToWait) {
  Slam slam(Frames().camera, SmallOptions(), Execution::kThreaded);
  for (const auto& frame : Frames().frames)
    slam.Feed(frame);
  EXPECT_EQ(slam.Finish().frames_dropped, 0U);
  EXPECT_EQ(slam.Finish().frames.size(), Frames().frames.size());
}

}  // namespace
}  // namespace cslam
