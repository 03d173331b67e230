// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// Which sightings are one object, which are two, and what each is called.
#include "cslam/mapping/object_layer.h"
#include "cslam/mapping/test_object_layer.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

using test::BoxAt;
using test::kBearClass;
using test::kPlace;
using test::ObjectLayerTest;
using test::PoseLookingAt;
using test::Thing;

TEST_F(ObjectLayerTest, MeasuresWhatItSees) {
  room_.things = {Chair(kPlace)};
  EXPECT_EQ(Insert(front_).num_new, 1);
  ASSERT_EQ(map_.Objects().size(), 1U);
  const MapObject& chair = Object(0);
  EXPECT_EQ(chair.state, ObjectState::kCandidate);
  EXPECT_FALSE(chair.is_active);
  EXPECT_EQ(chair.class_id, kChairClass);
  EXPECT_NEAR(map_.CentroidOf(chair).z(), 1.75, 0.05) << "its front is all that shows";
  EXPECT_EQ(chair.num_sightings, 1);
  EXPECT_EQ(chair.history.size(), 1U);
}

TEST_F(ObjectLayerTest, IsOneObjectWhenAChairIsSeenFromAllSides) {
  room_.things = {Chair({0.0, 0.2, 0.0})};
  const std::vector<Eigen::Vector3d> places{
      {0.0, 0.0, -1.8}, {0.0, 0.0, 1.8}, {1.8, 0.0, 0.0}, {-1.8, 0.0, 0.0}};
  for (const Eigen::Vector3d& from : places) {
    room_.things[0].track = TrackId(static_cast<std::uint32_t>(map_.num_keyframe_ids()));
    Insert(PoseLookingAt(from, {0.0, 0.2, 0.0}));
  }
  ASSERT_EQ(map_.Objects().size(), 1U);
  EXPECT_EQ(Object(0).num_sightings, 4);
  EXPECT_LT((map_.CentroidOf(Object(0)) - Eigen::Vector3d(0.0, 0.2, 0.0)).norm(), 0.1);
  EXPECT_NEAR(Object(0).box.size_m.maxCoeff(), 0.8, 0.1);
  EXPECT_NEAR(Object(0).box.size_m.minCoeff(), 0.5, 0.1);
}

TEST_F(ObjectLayerTest, MakesNoBearOfWhatIsLargerThanBearsAre) {
  room_.things = {{BoxAt(kPlace, {1.0, 1.2, 0.5}), kBearClass, TrackId(1), 5.0F}};
  EXPECT_EQ(Insert(front_).num_new, 0);
  room_.things[0].box = BoxAt(kPlace, {0.3, 0.4, 0.3});
  EXPECT_EQ(Insert(front_).num_new, 1);
}

TEST_F(ObjectLayerTest, KeepsTwoChairsSideBySideApart) {
  room_.things = {Chair({-0.35, 0.2, 2.0}, 1), Chair({0.35, 0.2, 2.0}, 2)};
  for (int i = 0; i < 4; ++i)
    Insert(PoseLookingAt({-0.6 + 0.4 * i, 0.0, 0.0}, kPlace));
  ASSERT_EQ(map_.Objects().size(), 2U);
  EXPECT_EQ(Object(0).num_sightings, 4);
  EXPECT_EQ(Object(1).num_sightings, 4);
}

TEST_F(ObjectLayerTest, KeepsTwoChairsApartThatAreDetectedInTurn) {
  room_.things = {Chair({-0.35, 0.2, 2.0}, 1), Chair({0.35, 0.2, 2.0}, 2)};
  room_.things[1].is_detected = false;
  Insert(front_);
  room_.things[0].is_detected = false;
  room_.things[1].is_detected = true;
  Insert(front_);
  EXPECT_EQ(map_.Objects().size(), 2U) << "the first one stands elsewhere in the same picture";
}

TEST_F(ObjectLayerTest, KeepsABearOnAChairItsOwnThing) {
  const Thing bear{BoxAt({0.0, -0.1, 1.7}, {0.3, 0.35, 0.25}), kBearClass, TrackId(2), 5.0F};
  room_.things = {Chair(kPlace), bear};
  for (int i = 0; i < 4; ++i)
    Insert(PoseLookingAt({-0.6 + 0.4 * i, 0.0, 0.0}, kPlace));
  ASSERT_EQ(map_.Objects().size(), 2U);
  EXPECT_EQ(Object(0).class_id, kChairClass);
  EXPECT_EQ(Object(1).class_id, kBearClass);
  EXPECT_EQ(Object(1).num_sightings, 4);
}

TEST_F(ObjectLayerTest, MakesNoObjectOfAPiece) {
  room_.things = {{BoxAt(kPlace, {0.15, 0.15, 0.15}), kChairClass, TrackId(1), 2.0F}};
  EXPECT_EQ(Insert(front_).num_new, 0) << "a chair shows more of itself, or hides";
  room_.things[0].class_id = 41;
  EXPECT_EQ(Insert(front_).num_new, 1) << "a cup does not";
}

TEST_F(ObjectLayerTest, MakesANewObjectOfATrackThatStaysOffTheFirst) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  room_.things = {Chair(kPlace), Chair(kPlace + Eigen::Vector3d(0.9, 0.0, 0.6))};
  room_.things[0].is_detected = false;  // the track has found its thing behind
  EXPECT_EQ(Insert(front_).num_new, 0);
  EXPECT_EQ(Insert(front_).num_new, 0);
  EXPECT_EQ(Insert(front_).num_new, 1);
}

TEST_F(ObjectLayerTest, CallsAThingAsItsSizeSuggests) {
  constexpr int kSuitcaseClass = 28;
  const Eigen::Vector3d size(0.55, 0.5, 0.2);
  room_.things = {{BoxAt(kPlace, size), kChairClass, TrackId(1), 2.0F}};
  Settle(front_);
  room_.things[0].class_id = kSuitcaseClass;
  Insert(front_);
  ASSERT_EQ(map_.Objects().size(), 1U);
  EXPECT_EQ(Object(0).class_id, kSuitcaseClass) << "two votes to one, but no chair is so low";
}

TEST_F(ObjectLayerTest, MergesWhatDriftHadMadeTwo) {
  room_.things = {Chair(kPlace, 1)};
  Insert(front_);
  const Se3 drifted(front_.rotation, front_.translation + Eigen::Vector3d(1.5, 0.0, 0.0));
  room_.things = {Chair(kPlace + Eigen::Vector3d(1.5, 0.0, 0.0), 2)};
  Insert(drifted);
  ASSERT_EQ(map_.Objects().size(), 2U);
  EXPECT_EQ(layer_->MergeAllDoubles(map_), 0) << "they are 1.5 m apart";
  map_.SetPose(KeyframeId(1), front_);  // as a loop would
  EXPECT_EQ(layer_->MergeAllDoubles(map_), 1);
  EXPECT_EQ(map_.Objects(), std::vector<ObjectId>{ObjectId(0)});
  EXPECT_EQ(map_.Resolve(ObjectId(1)), ObjectId(0));
  EXPECT_EQ(Object(0).num_sightings, 2);
}

}  // namespace
}  // namespace cslam
