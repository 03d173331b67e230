// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/tracking/keyframe_policy.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

constexpr KeyframePolicyOptions kOptions{.min_inliers = 15,
                                         .max_interval_frames = 30,
                                         .reference_ratio = 0.75,
                                         .reference_ratio_first = 0.4,
                                         .near_tracked_low = 100,
                                         .near_creatable_high = 70,
                                         .max_in_flight = 3};

// A frame that sees the map well: no keyframe is needed.
KeyframePolicyInput WellTracked() {
  KeyframePolicyInput input;
  input.state = TrackingState::kTracking;
  input.num_inliers = 200;
  input.reference_points = 220;
  input.num_map_keyframes = 5;
  input.frames_since_keyframe = 3;
  input.near_tracked = 150;
  input.near_creatable = 300;
  return input;
}

TEST(ChooseKeyframe, NeedsNoneWhileTheMapIsSeenWell) {
  EXPECT_EQ(ChooseKeyframe(WellTracked(), kOptions), KeyframeReason::kNotNeeded);
}

TEST(ChooseKeyframe, WantsNoneUnlessTracking) {
  for (const auto state :
       {TrackingState::kInitialising, TrackingState::kRecentlyLost, TrackingState::kLost}) {
    KeyframePolicyInput input = WellTracked();
    input.state = state;
    input.frames_since_keyframe = 1000;
    EXPECT_EQ(ChooseKeyframe(input, kOptions), KeyframeReason::kNotTracking) << ToString(state);
  }
}

TEST(ChooseKeyframe, DoesNotTrustFramesWithFewInliers) {
  KeyframePolicyInput input = WellTracked();
  input.num_inliers = 14;
  EXPECT_EQ(ChooseKeyframe(input, kOptions), KeyframeReason::kFewInliers);
}

TEST(ChooseKeyframe, InsertsWhenTheReferenceIsLostFromView) {
  KeyframePolicyInput input = WellTracked();
  input.reference_points = 400;
  input.num_inliers = 300;
  EXPECT_EQ(ChooseKeyframe(input, kOptions), KeyframeReason::kNotNeeded) << "exactly the ratio";
  input.num_inliers = 299;
  EXPECT_EQ(ChooseKeyframe(input, kOptions), KeyframeReason::kReferenceLost);
}

TEST(ChooseKeyframe, IsMorePatientWithTheFirstKeyframe) {
  KeyframePolicyInput input = WellTracked();
  input.reference_points = 400;
  input.num_inliers = 200;
  EXPECT_EQ(ChooseKeyframe(input, kOptions), KeyframeReason::kReferenceLost);
  input.num_map_keyframes = 1;
  EXPECT_EQ(ChooseKeyframe(input, kOptions), KeyframeReason::kNotNeeded);
  input.num_inliers = 159;
  EXPECT_EQ(ChooseKeyframe(input, kOptions), KeyframeReason::kReferenceLost);
}

TEST(ChooseKeyframe, InsertsWhenTheLastOneIsTooLongAgo) {
  KeyframePolicyInput input = WellTracked();
  input.frames_since_keyframe = 29;
  EXPECT_EQ(ChooseKeyframe(input, kOptions), KeyframeReason::kNotNeeded);
  input.frames_since_keyframe = 30;
  EXPECT_EQ(ChooseKeyframe(input, kOptions), KeyframeReason::kTooLongAgo);
}

TEST(ChooseKeyframe, InsertsWhenNearPointsAreFewAndManyCouldBeMade) {
  KeyframePolicyInput input = WellTracked();
  input.near_tracked = 99;
  input.near_creatable = 71;
  EXPECT_EQ(ChooseKeyframe(input, kOptions), KeyframeReason::kNearPointsNeeded);
  input.near_creatable = 70;
  EXPECT_EQ(ChooseKeyframe(input, kOptions), KeyframeReason::kNotNeeded) << "none could be made";
}

TEST(ChooseKeyframe, HoldsBackWhileTheMapperIsBusy) {
  KeyframePolicyInput input = WellTracked();
  input.proposals_in_flight = 3;
  EXPECT_EQ(ChooseKeyframe(input, kOptions), KeyframeReason::kNotNeeded) << "none was needed";
  input.frames_since_keyframe = 30;
  EXPECT_EQ(ChooseKeyframe(input, kOptions), KeyframeReason::kMapperBusy);
  input.proposals_in_flight = 2;
  EXPECT_EQ(ChooseKeyframe(input, kOptions), KeyframeReason::kTooLongAgo);
}

TEST(KeyframeReason, TellsProposalsFromRefusals) {
  EXPECT_FALSE(IsProposal(KeyframeReason::kNotNeeded));
  EXPECT_FALSE(IsProposal(KeyframeReason::kMapperBusy));
  EXPECT_TRUE(IsProposal(KeyframeReason::kStartsMap));
  EXPECT_TRUE(IsProposal(KeyframeReason::kNearPointsNeeded));
}

}  // namespace
}  // namespace cslam
