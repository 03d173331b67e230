// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/tracking/local_map.h"

#include "cslam/map/map.h"
#include "cslam/map/test_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cslam {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Keyframes 0 to 4 in a row, each the parent of the next.
class LocalMapTest : public testing::Test {
 protected:
  LocalMapTest() : map_(test::kLevelScales) {
    map_.AddKeyframe(test::MakeKeyframe(0, 40));
    for (std::uint32_t i = 1; i < 5; ++i)
      map_.AddKeyframe(test::MakeKeyframe(i, 40, 0.0, KeyframeId(i - 1)));
  }
  std::vector<PointId> AddPoints(int count, const std::vector<std::uint32_t>& keyframes) {
    std::vector<PointId> added;
    for (int i = 0; i < count; ++i) {
      const PointId point = map_.AddPoint({0.0, 0.0, 3.0}, KeyframeId(keyframes.front()));
      for (const std::uint32_t k : keyframes)
        map_.AddObservation(point, KeyframeId(k), next_keypoint_.at(k)++);
      map_.RefreshAppearance(point);
      added.push_back(point);
    }
    return added;
  }
  Map map_;
  std::vector<int> next_keypoint_ = std::vector<int>(5, 0);
  LocalMapOptions options_{.min_shared_points = 3};
};

TEST_F(LocalMapTest, ReferenceSharesMostPoints) {
  auto matched = AddPoints(2, {1, 2});
  matched.push_back(AddPoints(1, {2}).front());
  const LocalMap local = SelectLocalMap(map_, matched, KeyframeId(4), options_);
  EXPECT_EQ(local.reference, KeyframeId(2));
}

TEST_F(LocalMapTest, HoldsWhoSharesPointsThenTheirRelatives) {
  const auto matched = AddPoints(3, {2});
  AddPoints(3, {2, 4});
  const LocalMap local = SelectLocalMap(map_, matched, KeyframeId(0), options_);
  EXPECT_THAT(local.keyframes, ElementsAre(KeyframeId(2), KeyframeId(4), KeyframeId(1)))
      << "the one that shares, its neighbour, its parent";
}

TEST_F(LocalMapTest, PointsAreThoseSeenAndNotYetMatched) {
  const auto matched = AddPoints(1, {2});
  const auto others = AddPoints(2, {2, 3});
  const LocalMap local = SelectLocalMap(map_, matched, KeyframeId(), options_);
  EXPECT_EQ(local.points, others);
}

TEST_F(LocalMapTest, StartsAtTheFallbackWithoutMatches) {
  const auto points = AddPoints(2, {3});
  const LocalMap local = SelectLocalMap(map_, {}, KeyframeId(3), options_);
  EXPECT_EQ(local.reference, KeyframeId(3));
  EXPECT_EQ(local.points, points);
  EXPECT_FALSE(SelectLocalMap(map_, {}, KeyframeId(9), options_).reference.valid());
}

TEST_F(LocalMapTest, IsNotLargerThanAllowed) {
  const auto matched = AddPoints(1, {0, 1, 2, 3, 4});
  options_.max_keyframes = 2;
  EXPECT_EQ(SelectLocalMap(map_, matched, KeyframeId(), options_).keyframes.size(), 2U);
}

TEST_F(LocalMapTest, IgnoresStaleIds) {
  const auto points = AddPoints(2, {3});
  map_.ErasePoint(points[0]);
  const std::vector matched{points[0], PointId(999), PointId()};
  EXPECT_FALSE(SelectLocalMap(map_, matched, KeyframeId(), options_).reference.valid());
}

// One point 3 m in front of a camera at the origin, found there at pyramid level 0.
class ExpectPointsTest : public testing::Test {
 protected:
  ExpectPointsTest() : map_(test::kLevelScales), model_(test::kLevelScales, 1.0) {
    Keyframe keyframe = test::MakeKeyframe(0, 1);
    auto data = std::make_shared<KeyframeData>(*keyframe.data);
    data->features.keypoints[0].octave = 0;
    keyframe.data = std::move(data);
    map_.AddKeyframe(std::move(keyframe));
    point_ = map_.AddPoint({0.0, 0.0, 3.0}, KeyframeId(0));
    map_.AddObservation(point_, KeyframeId(0), 0);
    map_.RefreshAppearance(point_);
    camera_.fx = camera_.fy = 500.0;
    camera_.cx = 320.0;
    camera_.cy = 240.0;
  }
  std::vector<ExpectedPoint> ExpectFrom(const Se3& T_world_camera) const {
    return ExpectPoints(map_, std::vector{point_}, T_world_camera, camera_,
                        UndistortedBounds(camera_), 0.08, model_, LocalMapOptions{});
  }
  static Se3 Turned(double angle_rad, const Eigen::Vector3d& position) {
    return {ExpSo3({0.0, angle_rad, 0.0}), position};
  }
  Map map_;
  MeasurementModel model_;
  PointId point_;
  Camera camera_;
};

TEST_F(ExpectPointsTest, SaysWhereAndHowLargeAPointShows) {
  const auto expected = ExpectFrom(Turned(0.0, {0.3, 0.0, 0.0}));
  ASSERT_EQ(expected.size(), 1U);
  EXPECT_EQ(expected[0].point, point_);
  EXPECT_NEAR(static_cast<double>(expected[0].query.uv_px.x()), 320.0 - 500.0 * 0.3 / 3.0, 1e-3);
  EXPECT_NEAR(static_cast<double>(expected[0].query.uv_px.y()), 240.0, 1e-3);
  EXPECT_NEAR(static_cast<double>(expected[0].query.disparity_px), 500.0 * 0.08 / 3.0, 1e-4);
}

TEST_F(ExpectPointsTest, SearchesWiderWhenSeenFromElsewhere) {
  const auto frontal = ExpectFrom(Se3());
  const auto oblique = ExpectFrom(Turned(0.0, {0.6, 0.0, 0.0}));
  ASSERT_EQ(frontal.size(), 1U);
  ASSERT_EQ(oblique.size(), 1U);
  EXPECT_GT(oblique[0].query.radius_px, frontal[0].query.radius_px);
}

TEST_F(ExpectPointsTest, ExpectsNothingBehindBesideOrOutOfReach) {
  EXPECT_EQ(ExpectFrom(Se3()).size(), 1U);
  EXPECT_THAT(ExpectFrom(Turned(3.14159, {0.0, 0.0, 0.0})), IsEmpty()) << "behind";
  EXPECT_THAT(ExpectFrom(Turned(1.0, {0.0, 0.0, 0.0})), IsEmpty()) << "outside the image";
  EXPECT_THAT(ExpectFrom(Turned(0.0, {0.0, 0.0, -2.0})), IsEmpty()) << "too far for level 0";
  EXPECT_THAT(ExpectFrom(Turned(0.0, {0.0, 0.0, 1.5})), IsEmpty()) << "too near for the top level";
  EXPECT_THAT(ExpectFrom(Turned(1.5708, {-3.0, 0.0, 3.0})), IsEmpty()) << "seen from the side";
}

TEST_F(ExpectPointsTest, ExpectsNoErasedPoint) {
  map_.ErasePoint(point_);
  EXPECT_THAT(ExpectFrom(Se3()), IsEmpty());
}

}  // namespace
}  // namespace cslam
