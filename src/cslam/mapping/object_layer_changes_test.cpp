// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// What is told to have changed: gone, come, moved, replaced.
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

TEST_F(ObjectLayerTest, TellsARemovalWhenAChairWasLookedThrough) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  const Stamp last_seen = Object(0).last_seen;
  room_.things.clear();
  const Stamp gone = now_;
  Insert(front_, std::vector{Through(ObjectId(0), 1)});
  EXPECT_EQ(Object(0).state, ObjectState::kPresent) << "one view may err";
  Insert(front_, std::vector{Through(ObjectId(0), 3)});
  EXPECT_EQ(Object(0).state, ObjectState::kAbsent);
  EXPECT_FALSE(Object(0).is_active);
  ASSERT_EQ(map_.changes().size(), 1U);
  const MapChange& change = map_.changes()[0];
  EXPECT_EQ(change.kind, MapChangeKind::kRemoved);
  EXPECT_EQ(change.object, ObjectId(0));
  EXPECT_EQ(change.last_seen_there, last_seen);
  ASSERT_TRUE(change.first_seen_absent);
  EXPECT_GE(*change.first_seen_absent, gone);
  EXPECT_GT(change.confidence, 0.5);
  EXPECT_FALSE(change.is_between_sessions);
}

TEST_F(ObjectLayerTest, TellsAMoveWithTheNewId) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  room_.things = {Chair({2.0, 0.2, 0.0}, 7)};
  Insert(front_, std::vector{Through(ObjectId(0), 4)});
  Settle(PoseLookingAt({0.0, 0.2, 0.0}, {2.0, 0.2, 0.0}));
  ASSERT_EQ(map_.Objects().size(), 2U);
  ASSERT_EQ(map_.changes().size(), 1U) << "a removal and an arrival are one move";
  EXPECT_EQ(map_.changes()[0].kind, MapChangeKind::kMoved);
  EXPECT_EQ(map_.changes()[0].object, ObjectId(0));
  EXPECT_EQ(map_.changes()[0].new_object, ObjectId(1));
}

TEST_F(ObjectLayerTest, TellsAMoveWhenTheNewPlaceIsSeenFirst) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  const Se3 right = PoseLookingAt({0.0, 0.2, 0.0}, {2.0, 0.2, 0.0});
  room_.things.clear();
  Insert(right);
  Insert(right);  // it was empty there
  room_.things = {Chair({2.0, 0.2, 0.0}, 7)};
  Settle(right);
  ASSERT_EQ(map_.changes().size(), 1U);
  EXPECT_EQ(map_.changes()[0].kind, MapChangeKind::kAdded);
  Insert(front_, std::vector{Through(ObjectId(0), 4)});
  ASSERT_EQ(map_.changes().size(), 1U);
  EXPECT_EQ(map_.changes()[0].kind, MapChangeKind::kMoved);
  EXPECT_EQ(map_.changes()[0].new_object, ObjectId(1));
}

TEST_F(ObjectLayerTest, TellsAReplacementWhenAnotherThingStandsThere) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  room_.things = {{BoxAt({0.0, 0.4, 2.0}, {0.3, 0.4, 0.3}), kBearClass, TrackId(9), 5.0F}};
  Insert(front_, std::vector{Through(ObjectId(0), 4)});
  Settle(front_);
  ASSERT_EQ(map_.changes().size(), 1U);
  EXPECT_EQ(map_.changes()[0].kind, MapChangeKind::kReplaced);
  EXPECT_EQ(map_.changes()[0].object, ObjectId(0));
  EXPECT_EQ(map_.changes()[0].new_object, ObjectId(1));
}

TEST_F(ObjectLayerTest, TellsAnAdditionWhereThePlaceWasSeenEmpty) {
  Insert(front_);
  Insert(front_);
  room_.things = {Chair(kPlace)};
  Settle(front_);
  ASSERT_EQ(map_.changes().size(), 1U);
  EXPECT_EQ(map_.changes()[0].kind, MapChangeKind::kAdded);
  EXPECT_EQ(map_.changes()[0].object, ObjectId(0));
}

TEST_F(ObjectLayerTest, ContinuesTheHistoryOfWhatComesBack) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  room_.things.clear();
  Insert(front_, std::vector{Through(ObjectId(0), 4)});
  ASSERT_EQ(Object(0).state, ObjectState::kAbsent);
  room_.things = {Chair(kPlace, 5)};
  Insert(front_, std::vector{Seen(ObjectId(0), 5)});
  ASSERT_EQ(map_.Objects().size(), 1U) << "it has its old id";
  EXPECT_EQ(Object(0).state, ObjectState::kPresent);
  EXPECT_FALSE(Object(0).absent_since);
  EXPECT_GT(Object(0).history.size(), 2U);
  ASSERT_EQ(map_.changes().size(), 2U);
  EXPECT_EQ(map_.changes()[1].kind, MapChangeKind::kAdded);
}

TEST_F(ObjectLayerTest, DisplacesWhatALaterThingStandsOn) {
  const Thing bear{BoxAt(kPlace, {0.3, 0.3, 0.3}), kBearClass, TrackId(1), 5.0F};
  room_.things = {bear};
  Settle(front_);
  room_.things = {Chair(kPlace, 2)};  // nobody looks through: it stands all around
  for (const double x : {-1.5, 0.0, 1.5})
    Settle(PoseLookingAt({x, 0.2, 0.3}, kPlace));
  EXPECT_EQ(Object(0).state, ObjectState::kAbsent);
  ASSERT_EQ(map_.changes().size(), 1U);
  EXPECT_EQ(map_.changes()[0].kind, MapChangeKind::kReplaced);
  EXPECT_EQ(map_.changes()[0].new_object, ObjectId(1));
}

TEST_F(ObjectLayerTest, TakesADisplacementBackWhenBothAreSeenAtOnceLater) {
  room_.things = {{BoxAt(kPlace, {0.3, 0.3, 0.3}), kBearClass, TrackId(1), 5.0F}};
  Settle(front_);
  room_.things = {Chair(kPlace, 2)};
  for (const double x : {-1.5, 0.0, 1.5})
    Settle(PoseLookingAt({x, 0.2, 0.3}, kPlace));
  ASSERT_EQ(Object(0).state, ObjectState::kAbsent);
  now_ = now_ + 10'000'000'000LL;
  Insert(PoseLookingAt({0.0, 0.2, 0.0}, -kPlace),  // with what frames before it saw
         std::vector{Seen(ObjectId(0), 5), Seen(ObjectId(1), 1)});
  EXPECT_EQ(Object(0).state, ObjectState::kPresent);
  ASSERT_EQ(map_.changes().size(), 1U);
  EXPECT_EQ(map_.changes()[0].kind, MapChangeKind::kAdded);
  EXPECT_EQ(map_.changes()[0].object, ObjectId(1)) << "beside the first one there was nothing";
}

TEST_F(ObjectLayerTest, DisplacesNothingThatIsStillSeen) {
  room_.things = {{BoxAt(kPlace + Eigen::Vector3d(0.0, 0.0, -0.22), {0.3, 0.3, 0.3}), kBearClass,
                   TrackId(1), 5.0F}};
  Settle(front_);
  room_.things.push_back(Chair(kPlace, 2));  // the bear's front sticks out of it
  room_.things[0].is_detected = false;
  for (const double x : {-1.5, 0.0, 1.5})
    Settle(PoseLookingAt({x, 0.2, 0.3}, kPlace));
  EXPECT_EQ(Object(0).state, ObjectState::kPresent);
}

TEST_F(ObjectLayerTest, TellsAMoveToAPlaceWhereSomethingWasSuspectedBefore) {
  const Eigen::Vector3d there(2.0, 0.2, 0.0);
  const Se3 right = PoseLookingAt({0.0, 0.2, 0.0}, there);
  room_.things = {Chair(there, 3)};
  Insert(right);  // once: a candidate that nobody believes in
  room_.things = {Chair(kPlace)};
  Settle(front_);
  room_.things.clear();
  for (int i = 0; i < 3; ++i)
    Insert(right);  // empty
  room_.things = {Chair(there, 7)};
  now_ = now_ + 5'000'000'000LL;
  Settle(right);
  Insert(front_, std::vector{Through(ObjectId(1), 4)});
  ASSERT_EQ(map_.changes().size(), 1U);
  EXPECT_EQ(map_.changes()[0].kind, MapChangeKind::kMoved);
  EXPECT_EQ(map_.changes()[0].new_object, ObjectId(0));
}

TEST_F(ObjectLayerTest, TellsNothingOfAPieceThatIsLeftOfAThing) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  MapObject sliver = Object(0);
  ObjectSurface left = *sliver.surface;  // the rest turned out to belong to others
  left.voxels.resize(2);
  sliver.surface = std::make_shared<const ObjectSurface>(left);
  sliver.box.size_m = {0.1, 0.02, 0.02};
  map_.SetObject(sliver);
  room_.things.clear();
  Insert(front_, std::vector{Through(ObjectId(0), 4)});
  EXPECT_EQ(map_.FindObject(ObjectId(0)), nullptr);
  EXPECT_TRUE(map_.changes().empty());
}

TEST_F(ObjectLayerTest, MarksChangesBetweenSessions) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  map_.StartSession();
  layer_->Reset();
  room_.things.clear();
  Insert(front_, std::vector{Through(ObjectId(0), 4)});
  ASSERT_EQ(map_.changes().size(), 1U);
  EXPECT_TRUE(map_.changes()[0].is_between_sessions);
}

}  // namespace
}  // namespace cslam
