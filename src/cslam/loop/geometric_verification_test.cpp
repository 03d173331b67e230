// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/geometric_verification.h"

#include "cslam/map/test_room.h"
#include "cslam/util/check.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace cslam {
namespace {

constexpr std::uint32_t kFrame = 1000;  // seeds the noise of frames that are not in the map

PlaceSensor RoomSensor() {
  const Camera camera = test::RoomCamera();
  return {camera, UndistortedBounds(camera), test::kRoomBaselineM,
          MeasurementModel(test::kRoomScales, 1.0)};
}

// Half a circle of keyframes; the other half of the room is unknown to the map.
test::RoomMapper HalfCircle(const test::TestRoom& room) {
  test::RoomMapper mapper(room);
  KeyframeId last;
  for (int i = 0; i <= 10; ++i) {
    const Se3 T_world_camera = test::CirclePose(0.05 * i);
    last = mapper.Add(T_world_camera, T_world_camera, last);
  }
  return mapper;
}

class VerifyPlaceTest : public testing::Test {
 protected:
  PlaceVerification Verify(const FrameFeatures& features, std::uint32_t candidate) const {
    return VerifyPlace(features, map(), KeyframeId(candidate), sensor_, options_);
  }
  const MapView& map() const { return *view_; }
  FrameFeatures Look(const Se3& T_world_camera) const {
    return test::LookAtRoom(room_, sensor_.camera, T_world_camera, kFrame).data->features;
  }

  const test::TestRoom room_ = test::MakeRoom(1500, 3);
  test::RoomMapper mapper_ = HalfCircle(room_);
  const MapView* view_ = &mapper_.map();
  const PlaceSensor sensor_ = RoomSensor();
  VerificationOptions options_;
};

const Se3 kBetween = test::CirclePose(0.23);  // between keyframes 4 and 5

TEST_F(VerifyPlaceTest, FindsThePoseOfAFrameFromTheSamePlace) {
  const PlaceVerification seen = Verify(Look(kBetween), 4);
  ASSERT_TRUE(seen.IsAccepted()) << seen.reason;
  const PoseDifference error = Difference(kBetween, seen.T_world_camera);
  EXPECT_LT(error.distance_m, 0.01);
  EXPECT_LT(error.angle_rad, 0.005);
}

TEST_F(VerifyPlaceTest, ReportsWhatSpeaksForThePlace) {
  const FrameFeatures features = Look(kBetween);
  const PlaceVerification seen = Verify(features, 4);
  EXPECT_EQ(seen.candidate, KeyframeId(4));
  EXPECT_GE(seen.num_matches, seen.num_ransac_inliers);
  EXPECT_GT(seen.num_ransac_inliers, 50);
  EXPECT_GT(seen.ransac_iterations, 0);
  EXPECT_GE(seen.num_expected, seen.num_inliers);
  EXPECT_GE(seen.num_inliers, seen.num_strict_inliers);
  EXPECT_GT(seen.num_strict_inliers, 0);
  EXPECT_GE(seen.num_cells, 12);
  EXPECT_GT(seen.median_error_px, 0.0);
  EXPECT_LT(seen.median_error_px, 1.0);
  ASSERT_EQ(seen.points.size(), features.size());
  EXPECT_EQ(
      std::count_if(seen.points.begin(), seen.points.end(), [](PointId id) { return id.valid(); }),
      seen.num_inliers);
}

TEST_F(VerifyPlaceTest, InliersAreTheRoomsOwnPoints) {
  const test::RoomView frame = test::LookAtRoom(room_, sensor_.camera, kBetween, kFrame);
  const PlaceVerification seen = Verify(frame.data->features, 4);
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    if (!seen.points[i].valid()) continue;
    const auto& truth = room_.points[static_cast<std::size_t>(frame.points[i])].p_world;
    EXPECT_LT((map().FindPoint(seen.points[i])->p_world - truth).norm(), 0.1);
  }
}

TEST_F(VerifyPlaceTest, RefusesAFrameFromElsewhere) {
  const PlaceVerification seen = Verify(Look(test::CirclePose(0.75)), 4);
  EXPECT_EQ(seen.outcome, VerificationOutcome::kFewMatches);
  EXPECT_NE(seen.reason.find(" < 15"), std::string::npos) << seen.reason;
}

TEST_F(VerifyPlaceTest, RefusesTheSameLooksInAnotherArrangement) {
  FrameFeatures features = Look(kBetween);
  Rng rng(4);
  for (std::size_t i = features.size() - 1; i > 0; --i)
    std::swap(features.descriptors[i], features.descriptors[rng.Index(i + 1)]);
  const PlaceVerification seen = Verify(features, 4);
  EXPECT_EQ(seen.outcome, VerificationOutcome::kNoPose) << seen.reason;
  EXPECT_GT(seen.num_matches, 100);
}

TEST_F(VerifyPlaceTest, RefusesWhenTheFeaturesLieOnPeopleOrMovableThings) {
  FrameFeatures features = Look(kBetween);
  for (std::size_t i = 0; i < features.size(); ++i) {
    features.semantics[i].label = i % 2 == 0 ? KeypointLabel::kDynamic : KeypointLabel::kMovable;
  }
  EXPECT_EQ(Verify(features, 4).num_matches, 0);
}

TEST_F(VerifyPlaceTest, UsesOnlyPointsTheFilterAdmits) {
  const FrameFeatures features = Look(kBetween);
  const auto is_even = [](const MapPoint& point) { return point.id.value() % 2 == 0; };
  const PlaceVerification seen =
      VerifyPlace(features, map(), KeyframeId(4), sensor_, options_, is_even);
  ASSERT_TRUE(seen.IsAccepted()) << seen.reason;
  for (const PointId id : seen.points)
    EXPECT_TRUE(!id.valid() || id.value() % 2 == 0);
}

TEST_F(VerifyPlaceTest, RefusesInliersInOneCornerOfTheImage) {
  options_.min_inliers = 15;
  FrameFeatures features = Look(kBetween);
  for (std::size_t i = 0; i < features.size(); ++i) {
    const Eigen::Vector2f& uv = features.keypoints[i].uv_px;
    if (uv.x() > 310.0F || uv.y() > 230.0F) features.semantics[i].label = KeypointLabel::kDynamic;
  }
  const PlaceVerification seen = Verify(features, 4);
  EXPECT_EQ(seen.outcome, VerificationOutcome::kBadlySpread) << seen.reason;
  EXPECT_LE(seen.num_cells, 4);
}

TEST_F(VerifyPlaceTest, NeedsNoDepthOfTheFrame) {
  FrameFeatures features = Look(kBetween);
  for (Keypoint& keypoint : features.keypoints) {
    keypoint.depth_m = 0.0F;
    keypoint.disparity_px = -1.0F;
  }
  const PlaceVerification seen = Verify(features, 4);
  ASSERT_TRUE(seen.IsAccepted()) << seen.reason;
  EXPECT_LT(Difference(kBetween, seen.T_world_camera).distance_m, 0.02);
}

TEST_F(VerifyPlaceTest, GivesTheSameAnswerTwice) {
  const FrameFeatures features = Look(kBetween);
  const PlaceVerification a = Verify(features, 4);
  const PlaceVerification b = Verify(features, 4);
  EXPECT_EQ(a.T_world_camera.translation, b.T_world_camera.translation);
  EXPECT_EQ(a.points, b.points);
}

TEST_F(VerifyPlaceTest, RefusesAFrameWithoutFeatures) {
  EXPECT_EQ(Verify(FrameFeatures{}, 4).outcome, VerificationOutcome::kFewMatches);
}

TEST_F(VerifyPlaceTest, ThrowsWhenTheCandidateIsGone) {
  EXPECT_THROW(Verify(Look(kBetween), 99), InternalError);
}

}  // namespace
}  // namespace cslam
