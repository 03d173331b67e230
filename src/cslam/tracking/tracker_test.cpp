// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/tracking/tracker.h"

#include "cslam/sim/test_frames.h"
#include "cslam/tracking/test_mapper.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace cslam {
namespace {

using testing::HasSubstr;

const test::TestFrames& Frames() {
  static const auto frames = test::MakeTestFrames(
      {.width = 320, .height = 240, .fps = 15.0, .num_frames = 40, .noise = SensorNoise::kOff});
  return frames;
}

TrackerOptions MakeOptions() {
  TrackerOptions options;
  options.orb.num_features = 500;
  options.recently_lost_s = 0.5;
  return options;
}

// A tracker and a map that takes its proposals at once, fed with the simulated frames.
class TrackerTest : public testing::Test {
 protected:
  TrackerTest()
      : options_(MakeOptions()),
        mapper_(Frames().camera, LevelScales(options_.orb)),
        tracker_(Frames().camera, options_) {}

  TrackingResult Process(const RgbdFrame& frame) {
    TrackerOutput output = tracker_.Process(frame, snapshot_);
    last_proposal_ = std::move(output.proposal);
    if (last_proposal_ && mapper_listens_) {
      mapper_.Apply(*last_proposal_);
      snapshot_ = mapper_.Publish();
    }
    return output.result;
  }
  TrackingResult Process(std::size_t i) { return Process(*Frames().frames[i]); }
  void ProcessUpTo(std::size_t end) {
    for (std::size_t i = 0; i < end; ++i)
      ASSERT_EQ(Process(i).state, TrackingState::kTracking) << "frame " << i;
  }
  // The pose of the frame as the simulator has it, in the frame of the first camera.
  static Se3 Truth(std::size_t i) {
    return Frames().truth[0].T_world_camera.Inverse() * Frames().truth[i].T_world_camera;
  }
  // The frame's image and depth replaced; its stamp kept.
  static RgbdFrame Blank(std::size_t i) {
    RgbdFrame frame = *Frames().frames[i];
    frame.gray = cv::Mat(frame.gray.size(), CV_8UC1, cv::Scalar(127));
    return frame;
  }

  const TrackerOptions options_;
  test::TestMapper mapper_;
  Tracker tracker_;
  std::shared_ptr<const MapSnapshot> snapshot_;
  std::optional<KeyframeProposal> last_proposal_;
  bool mapper_listens_ = true;
};

TEST_F(TrackerTest, FirstFrameStartsAMapAtTheOrigin) {
  const TrackingResult result = Process(0);
  EXPECT_EQ(result.state, TrackingState::kTracking);
  EXPECT_THAT(result.reason, HasSubstr("map 0 starts"));
  EXPECT_EQ(result.T_world_camera->translation, Eigen::Vector3d::Zero());
  EXPECT_EQ(result.keyframe_reason, KeyframeReason::kStartsMap);
  EXPECT_EQ(result.map, MapId(0));
  ASSERT_TRUE(last_proposal_.has_value());
  EXPECT_FALSE(last_proposal_->reference.valid());
  EXPECT_EQ(last_proposal_->id, KeyframeId(0));
  EXPECT_FALSE(last_proposal_->data->depth_small_mm.empty());
}

TEST_F(TrackerTest, FollowsTheCamera) {
  for (std::size_t i = 0; i < Frames().frames.size(); ++i) {
    const TrackingResult result = Process(i);
    ASSERT_TRUE(result.T_world_camera.has_value()) << "frame " << i << ": " << result.reason;
    const PoseDifference error = Difference(Truth(i), *result.T_world_camera);
    EXPECT_LT(error.distance_m, 0.04) << "frame " << i;
    EXPECT_LT(error.angle_rad, 0.012) << "frame " << i;
    EXPECT_GE(result.num_map_matches, result.num_inliers > 0 && i > 0 ? 1 : 0);
  }
  EXPECT_GT(snapshot_->map.num_keyframes(), 1U);
  EXPECT_EQ(mapper_.map().CheckInvariants(), "");
}

TEST_F(TrackerTest, PoseIsTheReferencesTimesTheRelativeOne) {
  ProcessUpTo(6);
  const TrackingResult result = Process(6);
  const Se3 T_world_reference = *snapshot_->map.T_world_keyframe(result.reference);
  const PoseDifference difference =
      Difference(*result.T_world_camera, T_world_reference * result.T_reference_camera);
  EXPECT_LT(difference.distance_m, 1e-9);
}

TEST_F(TrackerTest, TracksOnItsOwnDepthWhileTheMapperIsSilent) {
  mapper_listens_ = false;
  for (std::size_t i = 0; i < 8; ++i) {
    const TrackingResult result = Process(i);
    ASSERT_TRUE(result.T_world_camera.has_value()) << "frame " << i << ": " << result.reason;
    EXPECT_LT(Difference(Truth(i), *result.T_world_camera).distance_m, 0.06) << "frame " << i;
    EXPECT_EQ(result.num_map_matches, 0);
  }
}

TEST_F(TrackerTest, ProposesNoMoreThanAllowedWhileTheMapperIsSilent) {
  mapper_listens_ = false;
  int num_proposals = 0;
  for (std::size_t i = 0; i < 30; ++i) {
    Process(i);
    if (last_proposal_) ++num_proposals;
  }
  EXPECT_GE(num_proposals, 1);
  EXPECT_LE(num_proposals, options_.keyframe.max_in_flight);
}

TEST_F(TrackerTest, ProposalNamesItsMatchesAndWhatWasSeenSinceTheLast) {
  for (std::size_t i = 0; i < 30; ++i) {
    Process(i);
    if (i > 0 && last_proposal_) break;
  }
  ASSERT_TRUE(last_proposal_.has_value()) << "30 frames without a keyframe";
  EXPECT_EQ(last_proposal_->matches.size(), last_proposal_->data->features.size());
  EXPECT_FALSE(last_proposal_->sightings.empty());
  for (const PointSightings& s : last_proposal_->sightings) {
    EXPECT_TRUE(s.point.valid());
    EXPECT_GE(s.expected, s.found);
    EXPECT_GE(s.expected, 1);
  }
}

// What the house promises: a correction that moves the whole map, and culls the keyframe the
// tracker stands on, is followed without a jump.
TEST_F(TrackerTest, SeesNoJumpWhenTheMapMovesAndItsReferenceIsCulled) {
  ProcessUpTo(20);
  const TrackingResult before = Process(20);
  ASSERT_TRUE(before.T_world_camera.has_value());

  const Se3 T_new_old(ExpSo3({0.0, 0.0, 1.2}), {4.0, -3.0, 0.5});
  mapper_.MoveEverything(T_new_old);
  const KeyframeId reference = before.reference;
  const bool was_culled = snapshot_->map.FindKeyframe(reference)->parent.valid();
  if (was_culled) mapper_.map().CullKeyframe(reference);
  snapshot_ = mapper_.Publish();
  EXPECT_TRUE(was_culled) << "the test wants a reference that can be culled";

  for (std::size_t i = 21; i < 30; ++i) {
    const TrackingResult result = Process(i);
    ASSERT_TRUE(result.T_world_camera.has_value()) << "frame " << i << ": " << result.reason;
    const PoseDifference jump = Difference(T_new_old * Truth(i), *result.T_world_camera);
    EXPECT_LT(jump.distance_m, 0.05) << "frame " << i;
    EXPECT_LT(jump.angle_rad, 0.015) << "frame " << i;
  }
}

TEST_F(TrackerTest, FollowsACorrectionAsWellAsIfThereHadBeenNone) {
  ProcessUpTo(20);
  Tracker undisturbed(Frames().camera, options_);
  test::TestMapper other(Frames().camera, LevelScales(options_.orb));
  std::shared_ptr<const MapSnapshot> snapshot;
  TrackingResult expected;
  for (std::size_t i = 0; i <= 20; ++i) {
    TrackerOutput output = undisturbed.Process(*Frames().frames[i], snapshot);
    if (output.proposal) other.Apply(*output.proposal);
    if (output.proposal) snapshot = other.Publish();
    expected = std::move(output.result);
  }
  const Se3 T_new_old(ExpSo3({0.3, 0.0, -0.7}), {1.0, 2.0, 3.0});
  mapper_.MoveEverything(T_new_old);
  snapshot_ = mapper_.Publish();
  const TrackingResult result = Process(20);
  ASSERT_TRUE(result.T_world_camera.has_value()) << result.reason;
  const PoseDifference jump =
      Difference(T_new_old * *expected.T_world_camera, *result.T_world_camera);
  EXPECT_LT(jump.distance_m, 1e-4);
  EXPECT_LT(jump.angle_rad, 1e-4);
  EXPECT_NEAR(result.num_inliers, expected.num_inliers, 3);
}

TEST_F(TrackerTest, StaleIdsOfTheLastFrameDoNoHarm) {
  ProcessUpTo(10);
  Map& map = mapper_.map();
  std::vector<PointId> alive;
  for (std::uint32_t i = 0; i < map.num_point_ids(); ++i) {
    if (map.FindPoint(PointId(i)) != nullptr) alive.push_back(PointId(i));
  }
  for (std::size_t i = 0; i + 3 < alive.size(); i += 4) {
    map.ErasePoint(alive[i]);
    map.FusePoints(alive[i + 1], alive[i + 2]);
  }
  snapshot_ = mapper_.Publish();
  const TrackingResult result = Process(10);
  ASSERT_TRUE(result.T_world_camera.has_value()) << result.reason;
  EXPECT_LT(Difference(Truth(10), *result.T_world_camera).distance_m, 0.05);
}

TEST_F(TrackerTest, PredictsByTimeNotByFrameCount) {
  ProcessUpTo(20);
  const TrackingResult result = Process(23);
  ASSERT_TRUE(result.T_world_camera.has_value()) << result.reason;
  EXPECT_LT(Difference(Truth(23), *result.T_world_camera).distance_m, 0.05);
}

TEST_F(TrackerTest, IsRecentlyLostAtFirstAndRecoversWhenItSeesAgain) {
  ProcessUpTo(6);
  const TrackingResult lost = Process(Blank(6));
  EXPECT_EQ(lost.state, TrackingState::kRecentlyLost);
  EXPECT_FALSE(lost.reason.empty());
  EXPECT_FALSE(lost.T_world_camera.has_value()) << "extrapolated poses never count";
  EXPECT_FALSE(last_proposal_.has_value());
  const TrackingResult found = Process(7);
  EXPECT_EQ(found.state, TrackingState::kTracking);
  EXPECT_EQ(found.map, MapId(0));
  EXPECT_LT(Difference(Truth(7), *found.T_world_camera).distance_m, 0.05);
}

TEST_F(TrackerTest, GivesUpAfterAWhileAndStartsANewMap) {
  ProcessUpTo(6);
  std::size_t i = 6;
  for (; i < 13; ++i)  // 7 / 15 s since the last pose
    EXPECT_EQ(Process(Blank(i)).state, TrackingState::kRecentlyLost) << "frame " << i;
  for (; i < 16; ++i)
    EXPECT_EQ(Process(Blank(i)).state, TrackingState::kLost) << "frame " << i;
  const TrackingResult result = Process(i);
  EXPECT_EQ(result.state, TrackingState::kTracking);
  EXPECT_EQ(result.map, MapId(1));
  EXPECT_EQ(result.T_world_camera->translation, Eigen::Vector3d::Zero());
  ASSERT_TRUE(last_proposal_.has_value());
  EXPECT_FALSE(last_proposal_->reference.valid());
  EXPECT_EQ(mapper_.map().CheckInvariants(), "");

  const TrackingResult next = Process(i + 1);
  EXPECT_EQ(next.state, TrackingState::kTracking);
  EXPECT_EQ(next.map, MapId(1));
  EXPECT_LT(Difference(Truth(i).Inverse() * Truth(i + 1), *next.T_world_camera).distance_m, 0.03);
}

TEST_F(TrackerTest, BlankImageStaysInitialisingAndSaysWhy) {
  const TrackingResult result = Process(Blank(0));
  EXPECT_EQ(result.state, TrackingState::kInitialising);
  EXPECT_EQ(result.num_keypoints, 0);
  EXPECT_THAT(result.reason, HasSubstr("0 keypoints with depth"));
  EXPECT_FALSE(result.T_world_camera.has_value());
}

TEST_F(TrackerTest, FramesWithoutDepthStayInitialisingAndSayWhy) {
  RgbdFrame frame = *Frames().frames[0];
  frame.depth_m = cv::Mat(frame.depth_m.size(), CV_32FC1, cv::Scalar(0.0));
  const TrackingResult result = Process(frame);
  EXPECT_EQ(result.state, TrackingState::kInitialising);
  EXPECT_GT(result.num_keypoints, 100);
  EXPECT_THAT(result.reason, HasSubstr("0 keypoints with depth < "));
  EXPECT_EQ(Process(1).state, TrackingState::kTracking) << "starts with the first good frame";
}

TEST_F(TrackerTest, TracksAFrameWithoutDepthOnceThereIsAMap) {
  ProcessUpTo(8);
  RgbdFrame frame = *Frames().frames[8];
  frame.depth_m = cv::Mat(frame.depth_m.size(), CV_32FC1, cv::Scalar(0.0));
  const TrackingResult result = Process(frame);
  ASSERT_TRUE(result.T_world_camera.has_value()) << result.reason;
  EXPECT_LT(Difference(Truth(8), *result.T_world_camera).distance_m, 0.06);
}

TEST_F(TrackerTest, ResetStartsANewMapWithNewIds) {
  ProcessUpTo(4);
  const auto first_ids = snapshot_->map.num_keyframe_ids();
  tracker_.Reset();
  const TrackingResult result = Process(4);
  EXPECT_EQ(result.map, MapId(1));
  ASSERT_TRUE(last_proposal_.has_value());
  EXPECT_GE(last_proposal_->id.index(), first_ids);
}

TEST_F(TrackerTest, MapThatVanishesIsNoticed) {
  ProcessUpTo(4);
  snapshot_.reset();
  mapper_listens_ = false;
  const TrackingResult result = Process(4);
  EXPECT_EQ(result.map, MapId(1)) << "nothing to come back to: starts anew at once";
  EXPECT_EQ(result.state, TrackingState::kTracking);
}

TEST_F(TrackerTest, SaysHowLongItsStepsTook) {
  ProcessUpTo(3);
  std::vector<std::string> stages;
  for (const StageTime& time : Process(3).times) {
    stages.emplace_back(time.stage);
    EXPECT_GE(time.ms, 0.0);
  }
  EXPECT_THAT(stages, testing::ElementsAre("extract", "label", "predict", "local_map", "objects"));
}

}  // namespace
}  // namespace cslam
