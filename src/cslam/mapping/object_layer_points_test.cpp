// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// Which map points are an object's, and which of them count.
#include "cslam/mapping/object_layer.h"
#include "cslam/mapping/test_object_layer.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

using test::kPlace;
using test::ObjectLayerTest;
using test::PoseLookingAt;

TEST_F(ObjectLayerTest, ForgetsCandidatesThatWereNeverThere) {
  room_.things = {Chair(kPlace)};
  has_points_ = true;
  keypoint_track_ = TrackId(1);
  Insert(front_);
  EXPECT_EQ(map_.PointsOfObject(ObjectId(0)).size(), 1U);
  room_.things.clear();
  keypoint_track_ = {};
  Insert(front_, std::vector{Through(ObjectId(0), 3)});
  EXPECT_TRUE(map_.Objects().empty());
  EXPECT_TRUE(map_.changes().empty());
  EXPECT_EQ(map_.FindPoint(PointId(0)), nullptr) << "what stood on it is gone as well";
}

TEST_F(ObjectLayerTest, ActivatesPointsWithTheirObjectAndHoldsThemBackWhenItGoes) {
  room_.things = {Chair(kPlace)};
  has_points_ = true;
  keypoint_track_ = TrackId(1);
  Insert(front_);
  ASSERT_EQ(map_.PointsOfObject(ObjectId(0)), std::vector<PointId>{PointId(0)});
  EXPECT_FALSE(IsUsable(*map_.FindPoint(PointId(0))));
  EXPECT_TRUE(IsUsable(*map_.FindPoint(PointId(1)))) << "it is on the wall";
  Insert(front_, std::vector{Seen(ObjectId(0))});
  EXPECT_TRUE(IsUsable(*map_.FindPoint(PointId(0))));
  room_.things.clear();
  keypoint_track_ = {};
  has_points_ = false;
  Insert(front_, std::vector{Through(ObjectId(0), 4)});
  EXPECT_FALSE(IsUsable(*map_.FindPoint(PointId(0))));
}

TEST_F(ObjectLayerTest, SweepsUnnamedPointsFromAPlaceThatIsLookedThrough) {
  room_.things = {Chair(kPlace)};
  has_points_ = true;  // but keypoints have no name
  Settle(front_);
  ASSERT_TRUE(map_.PointsOfObject(ObjectId(0)).empty());
  room_.things.clear();
  has_points_ = false;
  Insert(front_, std::vector{Through(ObjectId(0), 4)});
  EXPECT_FALSE(IsUsable(*map_.FindPoint(PointId(0))));
  EXPECT_TRUE(IsUsable(*map_.FindPoint(PointId(1))));
}

TEST_F(ObjectLayerTest, SweepsWhatStoodRightBesideThePartThatWasKnown) {
  for (const auto& [beside_m, is_swept] : {std::pair{0.2, true}, {0.6, false}}) {
    has_points_ = true;
    room_.things = {Chair(kPlace)};
    const ObjectId chair = Settle(front_).back();
    Insert(front_, std::vector{Seen(chair, 20)});
    const PointId point(static_cast<std::uint32_t>(map_.num_point_ids() - 2));
    MapObject known = *map_.FindObject(chair);
    const Eigen::Vector3d p_object =
        map_.T_world_object(known).Inverse() * map_.FindPoint(point)->p_world;
    known.box.rotation = Eigen::Quaterniond::Identity();
    known.box.center = p_object;
    known.box.center.x() += 0.5 * known.box.size_m.x() + beside_m;
    map_.SetObject(std::move(known));
    has_points_ = false;
    room_.things.clear();
    Insert(front_, std::vector{Through(chair, 12)});
    EXPECT_EQ(map_.FindPoint(point)->object.valid(), is_swept) << beside_m;
  }
}

// The clock may have jumped in between, or the camera have looked elsewhere.
TEST_F(ObjectLayerTest, SweepsAPlaceWheneverItWasLookedThroughFirst) {
  for (const std::int64_t passed_s : {3600, -3600}) {
    has_points_ = true;
    room_.things = {Chair(kPlace)};
    const ObjectId chair = Settle(front_).back();
    Insert(front_, std::vector{Seen(chair, 20)});
    ASSERT_EQ(map_.FindObject(chair)->state, ObjectState::kPresent);
    const PointId point(static_cast<std::uint32_t>(map_.num_point_ids() - 2));
    ASSERT_FALSE(map_.FindPoint(point)->object.valid());
    has_points_ = false;
    room_.things.clear();
    ObjectEvidence evidence = Through(chair, 12);
    evidence.first_through = now_ + -passed_s * 1'000'000'000LL;
    Insert(front_, std::vector{evidence});
    ASSERT_EQ(map_.FindObject(chair)->state, ObjectState::kAbsent);
    EXPECT_EQ(map_.FindPoint(point)->object, chair) << passed_s;
  }
}

TEST_F(ObjectLayerTest, GoesOnSweepingThePlaceOfWhatHasGone) {
  has_points_ = true;
  room_.things = {Chair(kPlace)};
  Settle(front_);
  room_.things = {};
  const Se3 aside = PoseLookingAt({0.0, 0.2, 0.0}, {3.0, 0.2, 0.0});  // it is behind the camera
  Insert(aside, std::vector{Through(ObjectId(0), 4)});
  ASSERT_EQ(Object(0).state, ObjectState::kAbsent);
  ASSERT_FALSE(map_.FindPoint(PointId(0))->object.valid()) << "nobody has looked there since";
  Insert(front_);
  EXPECT_EQ(map_.FindPoint(PointId(0))->object, ObjectId(0));
}

TEST_F(ObjectLayerTest, MeasuresByMapPointsWhenToldSo) {
  MapObjectOptions objects;
  objects.extent = "points";
  MakeLayer(objects);
  room_.things = {Chair(kPlace)};
  has_points_ = true;
  keypoint_track_ = TrackId(1);
  Insert(front_);
  Insert(front_);
  const Eigen::Vector3d centroid = map_.CentroidOf(Object(0));
  EXPECT_LT((centroid - map_.FindPoint(PointId(0))->p_world).norm(), 1e-6);
}

}  // namespace
}  // namespace cslam
