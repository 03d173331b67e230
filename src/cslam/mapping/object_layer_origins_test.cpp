// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a thing that came stood before, if nobody had named it there, or not by this name.
#include "cslam/mapping/object_layer.h"
#include "cslam/mapping/test_object_layer.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

using test::BoxAt;
using test::kBearClass;
using test::kChairSize;
using test::KindsToldIn;
using test::kPlace;
using test::PoseLookingAt;
using test::Thing;

const Eigen::Vector3d kNewPlace(2.0, 0.2, 0.0);

class ObjectOriginsTest : public test::ObjectLayerTest {
 protected:
  static Thing NamelessChair(float hue = 2.0F) {
    Thing chair = Chair(kPlace);
    chair.is_detected = false;
    chair.hue = hue;
    return chair;
  }
  // Looks at the old place, then at the new one, which is still empty.
  void LookAtBoth(const Thing& at_old_place) {
    room_.things = {at_old_place};
    Watch(front_, 4);
    Watch(right_, 3);
  }
  // A chair stands at the new place, and nothing at the old one.
  void SeeChairAtNewPlace() {
    room_.things = {Chair(kNewPlace, 7)};
    Watch(right_, 4);
  }

  using Told = std::vector<MapChangeKind>;
  const Se3 right_ = PoseLookingAt({0.0, 0.2, 0.0}, kNewPlace);
};

TEST_F(ObjectOriginsTest, AThingThatNobodyHadNamedHasMovedOnceItsOldPlaceIsSeenEmpty) {
  LookAtBoth(NamelessChair());
  EXPECT_TRUE(map_.Objects().empty());
  SeeChairAtNewPlace();
  EXPECT_EQ(KindsToldIn(map_), Told{MapChangeKind::kAdded});
  Watch(front_, 3);
  ASSERT_EQ(KindsToldIn(map_), Told{MapChangeKind::kMoved});
  const MapChange& moved = map_.changes()[0];
  const MapObject& origin = *map_.FindObject(moved.object);
  EXPECT_EQ(origin.state, ObjectState::kAbsent);
  EXPECT_EQ(origin.class_id, kChairClass);
  EXPECT_LT((map_.CentroidOf(origin) - kPlace).norm(), 0.4);
  EXPECT_EQ(map_.FindObject(moved.new_object)->state, ObjectState::kPresent);
  EXPECT_LT(moved.last_seen_there, *moved.first_seen_absent);
  EXPECT_GT(moved.num_absent_views, 0);
}

TEST_F(ObjectOriginsTest, TheOldPlaceMayBeSeenEmptyBeforeTheNewOneIsSeenTaken) {
  LookAtBoth(NamelessChair());
  room_.things.clear();
  Watch(front_, 3);
  SeeChairAtNewPlace();
  EXPECT_EQ(KindsToldIn(map_), Told{MapChangeKind::kMoved});
}

TEST_F(ObjectOriginsTest, OfOtherColoursItIsAnotherThing) {
  LookAtBoth(NamelessChair(5.0F));
  SeeChairAtNewPlace();
  Watch(front_, 3);
  EXPECT_EQ(KindsToldIn(map_), Told{MapChangeKind::kAdded});
}

TEST_F(ObjectOriginsTest, OfAnotherSizeItIsAnotherThing) {
  Thing small = NamelessChair();
  small.box = BoxAt(kPlace, 0.4 * kChairSize);
  LookAtBoth(small);
  SeeChairAtNewPlace();
  Watch(front_, 3);
  EXPECT_EQ(KindsToldIn(map_), Told{MapChangeKind::kAdded});
}

TEST_F(ObjectOriginsTest, WhatStillStandsWhereItStoodHasNotMoved) {
  LookAtBoth(NamelessChair());
  SeeChairAtNewPlace();
  room_.things.push_back(NamelessChair());
  Watch(front_, 3);
  EXPECT_EQ(KindsToldIn(map_), Told{MapChangeKind::kAdded});
}

TEST_F(ObjectOriginsTest, AThingOfAnotherNameThatLooksTheSameHasMoved) {
  Thing bear = NamelessChair();
  bear.is_detected = true;
  bear.class_id = kBearClass;
  LookAtBoth(bear);
  ASSERT_EQ(map_.Objects().size(), 1U);
  SeeChairAtNewPlace();
  Watch(front_, 4);
  EXPECT_EQ(KindsToldIn(map_), Told{MapChangeKind::kMoved});
  EXPECT_EQ(map_.Objects().size(), 2U) << "no third one where the first one stood";
  EXPECT_EQ(Object(0).class_id, kChairClass);
  EXPECT_EQ(Object(0).state, ObjectState::kAbsent);
}

TEST_F(ObjectOriginsTest, WaitsWhileAKnownThingMayHaveMoved) {
  const Eigen::Vector3d left(-2.0, 0.2, 0.0);
  const Se3 look_left = PoseLookingAt({0.0, 0.2, 0.0}, left);
  room_.things = {NamelessChair(), Chair(left, 3)};
  Watch(look_left, 3);
  Watch(front_, 4);
  Watch(right_, 3);
  SeeChairAtNewPlace();
  Watch(front_, 3);
  EXPECT_EQ(KindsToldIn(map_), Told{MapChangeKind::kAdded})
      << "it may be the one that stood on the left";
  room_.things.push_back(Chair(left, 3));
  Watch(look_left, 1);
  Watch(front_, 1);
  Watch(right_, 1);
  EXPECT_EQ(KindsToldIn(map_), Told{MapChangeKind::kMoved}) << "but that is still there";
}

TEST_F(ObjectOriginsTest, IsNotLookedForIfTurnedOff) {
  MapObjectOptions options;
  options.past.enabled = false;
  MakeLayer(options);
  LookAtBoth(NamelessChair());
  SeeChairAtNewPlace();
  Watch(front_, 3);
  EXPECT_EQ(KindsToldIn(map_), Told{MapChangeKind::kAdded});
}

}  // namespace
}  // namespace cslam
