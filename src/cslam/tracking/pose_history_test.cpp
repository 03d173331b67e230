// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/tracking/pose_history.h"

#include "cslam/map/map.h"
#include "cslam/map/test_map.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

Se3 At(double x) {
  return {Eigen::Quaterniond::Identity(), {x, 0.0, 0.0}};
}

// Where the last frame is along x; nullopt when the history does not know.
std::optional<double> LastX(const PoseHistory& history, const MapView& map) {
  const auto T_world_last = history.T_world_last(map);
  if (!T_world_last) return std::nullopt;
  return T_world_last->translation.x();
}

class PoseHistoryTest : public testing::Test {
 protected:
  PoseHistoryTest() : map_(test::kLevelScales) {
    map_.AddKeyframe(test::MakeKeyframe(0, 5, 0.0));
    map_.AddKeyframe(test::MakeKeyframe(1, 5, 1.0, KeyframeId(0)));
  }
  Map map_;
  PoseHistory history_;
};

TEST_F(PoseHistoryTest, KnowsNothingAtFirst) {
  EXPECT_EQ(LastX(history_, map_), std::nullopt);
}

TEST_F(PoseHistoryTest, LastPoseFollowsItsReferenceKeyframe) {
  history_.SetLast(KeyframeId(1), At(0.5));
  EXPECT_EQ(LastX(history_, map_), 1.5);
  map_.SetPose(KeyframeId(1), At(7.0));
  EXPECT_EQ(LastX(history_, map_), 7.5);
}

TEST_F(PoseHistoryTest, LastPoseFollowsACulledReferenceToItsParent) {
  history_.SetLast(KeyframeId(1), At(0.5));
  map_.CullKeyframe(KeyframeId(1));
  EXPECT_EQ(LastX(history_, map_), 1.5);
  map_.SetPose(KeyframeId(0), At(10.0));
  EXPECT_EQ(LastX(history_, map_), 11.5);
}

TEST_F(PoseHistoryTest, PendingKeyframeStandsWhereItWasProposed) {
  history_.AddPending(KeyframeId(2), KeyframeId(1), At(0.25));
  history_.SetLast(KeyframeId(2), At(0.5));
  EXPECT_EQ(LastX(history_, map_), 1.75);
  map_.SetPose(KeyframeId(1), At(2.0));
  EXPECT_EQ(LastX(history_, map_), 2.75) << "moves with the keyframe it was proposed from";
}

TEST_F(PoseHistoryTest, PendingKeyframesMayStandOnEachOther) {
  history_.AddPending(KeyframeId(2), KeyframeId(1), At(0.25));
  history_.AddPending(KeyframeId(3), KeyframeId(2), At(0.5));
  history_.SetLast(KeyframeId(3), At(1.0));
  EXPECT_EQ(LastX(history_, map_), 2.75);
}

TEST_F(PoseHistoryTest, PendingFirstKeyframeOfAMapStandsInTheWorld) {
  const Map empty(test::kLevelScales);
  history_.AddPending(KeyframeId(0), KeyframeId(), At(3.0));
  history_.SetLast(KeyframeId(0), At(0.5));
  EXPECT_EQ(LastX(history_, empty), 3.5);
}

TEST_F(PoseHistoryTest, MapSaysWhereAKeyframeIsAsSoonAsItKnowsIt) {
  history_.AddPending(KeyframeId(2), KeyframeId(1), At(0.25));
  history_.AddPending(KeyframeId(3), KeyframeId(2), At(0.5));
  history_.SetLast(KeyframeId(3), At(1.0));
  map_.AddKeyframe(test::MakeKeyframe(2, 5, 5.0, KeyframeId(1)));
  history_.Update(map_);
  EXPECT_EQ(LastX(history_, map_), 6.5) << "keyframe 3 is still pending and stands on 2";
}

TEST_F(PoseHistoryTest, ForgottenKeyframeIsUnknown) {
  history_.SetLast(KeyframeId(1), At(0.5));
  map_.Clear();
  EXPECT_EQ(LastX(history_, map_), std::nullopt);
  history_.AddPending(KeyframeId(2), KeyframeId(), At(0.0));
  history_.SetLast(KeyframeId(2), At(0.0));
  history_.Clear();
  EXPECT_EQ(LastX(history_, map_), std::nullopt);
}

}  // namespace
}  // namespace cslam
