// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/object_changes.h"

#include "cslam/mapping/test_watched_room.h"
#include "cslam/semantics/coco.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

using test::KindsToldIn;

constexpr int kBearClass = 77;
const Stamp kNow{9'000'000'000LL};

class ChangeListTest : public test::WatchedRoomTest {
 protected:
  ChangeListTest() : list_(camera_, options_, classes_) {}

  void Leave(ObjectId id, Stamp now = kNow) {
    MapObject object = *map_.FindObject(id);
    object.state = ObjectState::kAbsent;
    object.log_odds = -3.0;
    object.absent_since = now;
    map_.SetObject(std::move(object));
    list_.OnGone(map_, id, now, 3, session_);
  }
  void Displace(ObjectId id, ObjectId by) {
    MapObject object = *map_.FindObject(id);
    object.state = ObjectState::kAbsent;
    object.absent_since = kNow;
    map_.SetObject(std::move(object));
    list_.OnDisplaced(map_, id, by, kNow, session_);
  }
  void Arrive(ObjectId id) { list_.OnArrived(map_, id, kNow, session_); }

  using Kind = MapChangeKind;
  const ObjectClasses classes_{ObjectClassOptions{}};
  std::uint32_t session_ = 0;
  ChangeList list_;
};

const Eigen::Vector3d kHere(0.0, 0.0, 2.0);
const Eigen::Vector3d kThere(0.9, 0.0, 2.2);

TEST_F(ChangeListTest, TellsASecondComingThoughTheFirstWasTold) {
  const ObjectId chair = AddObject(kHere, 7, 9);
  Arrive(chair);
  Leave(chair);
  Arrive(chair);  // with absent_since still set, as the layer does
  EXPECT_EQ(KindsToldIn(map_), (std::vector{Kind::kAdded, Kind::kRemoved, Kind::kAdded}));
}

TEST_F(ChangeListTest, TakesBackWhatAMistakeHadTold) {
  const ObjectId chair = AddObject(kHere, 7, 9);
  Arrive(chair);
  ASSERT_EQ(KindsToldIn(map_), std::vector{Kind::kAdded});
  list_.OnMistake(map_, chair);
  EXPECT_TRUE(map_.changes().empty());
}

TEST_F(ChangeListTest, LeavesARemovalWhenTheNewPlaceWasAMistake) {
  const ObjectId old_chair = AddObject(kHere, 0, 5);
  const ObjectId new_chair = AddObject(kThere, 12, 15);
  Arrive(new_chair);
  Leave(old_chair);
  ASSERT_EQ(KindsToldIn(map_), std::vector{Kind::kMoved});
  list_.OnMistake(map_, new_chair);
  EXPECT_EQ(KindsToldIn(map_), std::vector{Kind::kRemoved});
  EXPECT_FALSE(map_.changes()[0].new_object.valid());
}

TEST_F(ChangeListTest, GivesAnOriginToTheThingItWasFoundForThoughAnotherIsAlike) {
  const ObjectId origin = AddObject(kHere, 0, 5);
  const ObjectId chair = AddObject(kThere, 12, 15);
  const ObjectId twin = AddObject({-0.9, 0.0, 2.2}, 12, 15);
  Arrive(chair);
  Arrive(twin);
  MapObject gone = *map_.FindObject(origin);
  gone.state = ObjectState::kAbsent;
  gone.absent_since = kNow;
  map_.SetObject(std::move(gone));
  list_.OnOriginFound(map_, origin, chair, kNow, 3, session_);
  ASSERT_EQ(KindsToldIn(map_), (std::vector{Kind::kAdded, Kind::kMoved}));
  EXPECT_EQ(map_.changes()[0].object, twin);
  EXPECT_EQ(map_.changes()[1].new_object, chair);
}

TEST_F(ChangeListTest, TellsAMoveOnceTheNewPlaceIsKnownBetter) {
  const ObjectId old_chair = AddObject(kHere, 0, 5);
  const ObjectId new_chair = AddObject(kThere, 12, 15, kChairClass, 2.0F, 0.1);  // a leg
  Arrive(new_chair);
  Leave(old_chair);
  ASSERT_EQ(KindsToldIn(map_), (std::vector{Kind::kAdded, Kind::kRemoved}));
  MapObject whole = *map_.FindObject(new_chair);
  whole.box.size_m = Eigen::Vector3d::Constant(0.5);
  map_.SetObject(std::move(whole));
  Arrive(new_chair);
  EXPECT_EQ(KindsToldIn(map_), std::vector{Kind::kMoved});
}

TEST_F(ChangeListTest, CarriesTheVotesForAClassAlongWithAMove) {
  const ObjectId old_chair = AddObject(kHere, 0, 5);
  MapObject named = *map_.FindObject(old_chair);
  AddVote(named, {static_cast<std::int16_t>(kChairClass), 3.0F});
  map_.SetObject(std::move(named));
  const ObjectId new_chair = AddObject(kThere, 12, 15);
  Arrive(new_chair);
  Leave(old_chair);
  ASSERT_EQ(KindsToldIn(map_), std::vector{Kind::kMoved});
  ASSERT_EQ(map_.FindObject(new_chair)->votes.size(), 1U);
  EXPECT_EQ(map_.FindObject(new_chair)->votes[0].weight, 3.0F);
}

TEST_F(ChangeListTest, ToldAsAddedIfItsPlaceWasEmptyAndAsNothingIfNobodyLooked) {
  Arrive(AddObject(kThere, 0, 9));
  EXPECT_TRUE(map_.changes().empty()) << "it may always have been there";
  Arrive(AddObject(kHere, 7, 9));
  EXPECT_EQ(KindsToldIn(map_), std::vector{Kind::kAdded});
  EXPECT_EQ(map_.changes()[0].num_absent_views, 7);
}

TEST_F(ChangeListTest, OneViewOfAnEmptyPlaceIsTooFew) {
  Arrive(AddObject(kHere, 1, 9));
  EXPECT_TRUE(map_.changes().empty());
}

TEST_F(ChangeListTest, JoinsRemovalAndArrivalToAMoveInEitherOrder) {
  const ObjectId old_one = AddObject(kHere, 0, 5);
  const ObjectId new_one = AddObject(kThere, 8, 12);
  Leave(old_one);
  Arrive(new_one);
  ASSERT_EQ(KindsToldIn(map_), std::vector{Kind::kMoved});
  map_.SetChanges({});
  Arrive(new_one);
  Leave(old_one);
  ASSERT_EQ(KindsToldIn(map_), std::vector{Kind::kMoved});
  EXPECT_EQ(map_.changes()[0].object, old_one);
  EXPECT_EQ(map_.changes()[0].new_object, new_one);
  EXPECT_GT(map_.changes()[0].confidence, 0.8);
}

TEST_F(ChangeListTest, DoesNotTakeAnotherColourOrSizeForTheSameThing) {
  const ObjectId old_one = AddObject(kHere, 0, 5);
  Leave(old_one);
  Arrive(AddObject(kThere, 8, 12, kChairClass, 6.0F));
  Arrive(AddObject({-0.9, 0.0, 2.2}, 8, 12, kChairClass, 2.0F, 1.6));
  EXPECT_EQ(KindsToldIn(map_), (std::vector{Kind::kRemoved, Kind::kAdded, Kind::kAdded}));
}

TEST_F(ChangeListTest, AllowsForMoreDifferenceInSizeIfTheColoursAreEqual) {
  const ObjectId small = AddObject(kHere, 0, 5, kChairClass, 2.0F, 0.2);
  Leave(small);
  Arrive(AddObject(kThere, 8, 12, kChairClass, 2.0F, 0.5));
  EXPECT_EQ(KindsToldIn(map_), std::vector{Kind::kMoved});
}

TEST_F(ChangeListTest, DoesNotTakeWhatWasSeenAtTheSameTimeForTheSameThing) {
  const ObjectId old_one = AddObject(kHere, 0, 10);
  Arrive(AddObject(kThere, 8, 12));
  Leave(old_one, Stamp{20'000'000'000LL});
  EXPECT_EQ(KindsToldIn(map_), (std::vector{Kind::kAdded, Kind::kRemoved}));
}

TEST_F(ChangeListTest, ForgivesAMistakeWhileThePlaceIsFoundEmpty) {
  const auto seen_again_and_gone = [this](Stamp seen_between) {
    const ObjectId old_one = AddObject(kHere, 0, 15);  // seen last when its place was seen again
    Arrive(AddObject(kThere, 8, 12));
    MapObject object = *map_.FindObject(old_one);
    NoteBelief(object, seen_between, BeliefCause::kSeen);
    map_.SetObject(std::move(object));
    Leave(old_one, Stamp{16'000'000'000LL});
  };
  seen_again_and_gone(Stamp{5'000'000'000LL});
  EXPECT_EQ(KindsToldIn(map_), std::vector{Kind::kMoved});
  map_.SetChanges({});
  seen_again_and_gone(Stamp{12'000'000'000LL});
  EXPECT_EQ(KindsToldIn(map_), (std::vector{Kind::kAdded, Kind::kRemoved}))
      << "both were seen meanwhile";
}

TEST_F(ChangeListTest, TellsAReplacementNearThePlaceOnly) {
  Leave(AddObject(kHere, 0, 5));
  Arrive(AddObject(kThere, 8, 12, kBearClass, 5.0F));
  EXPECT_EQ(KindsToldIn(map_), (std::vector{Kind::kRemoved, Kind::kAdded})) << "0.9 m away";
  Arrive(AddObject(kHere, 8, 12, kBearClass, 5.0F));
  EXPECT_EQ(KindsToldIn(map_), (std::vector{Kind::kAdded, Kind::kReplaced}));
}

TEST_F(ChangeListTest, TellsAReplacementByWhatTheOldThingHadHidden) {
  Leave(AddObject(kHere, 0, 5));
  // Its place was never seen empty, for it lies within the old one's.
  Arrive(AddObject(kHere + Eigen::Vector3d(0.0, 0.1, 0.0), 1, 12, kBearClass, 5.0F, 0.2));
  EXPECT_TRUE(map_.changes()[0].kind == Kind::kRemoved) << "both were seen at once";
  map_.SetChanges({});
  Leave(AddObject(kHere, 0, 0));
  Arrive(AddObject(kHere + Eigen::Vector3d(0.0, 0.1, 0.0), 1, 12, kBearClass, 5.0F, 0.2));
  EXPECT_EQ(KindsToldIn(map_), std::vector{Kind::kReplaced});
}

TEST_F(ChangeListTest, PrefersAMoveToAReplacement) {
  Leave(AddObject(kHere, 0, 5));
  Leave(AddObject(kThere, 0, 5, kBearClass, 5.0F));
  Arrive(AddObject(kHere, 8, 12, kBearClass, 5.0F));
  EXPECT_EQ(KindsToldIn(map_), (std::vector{Kind::kRemoved, Kind::kMoved}));
  EXPECT_EQ(map_.changes()[1].object, ObjectId(1)) << "the bear";
}

TEST_F(ChangeListTest, DisplacedThingsAreReplacedOnceByEachNewOne) {
  const ObjectId chair = AddObject(kHere, 0, 5);
  const ObjectId cup = AddObject(kHere, 0, 5, 41, 1.0F, 0.1);
  const ObjectId bear = AddObject(kHere, 8, 12, kBearClass, 5.0F);
  Arrive(bear);
  ASSERT_EQ(KindsToldIn(map_), std::vector{Kind::kAdded});
  list_.OnDisplaced(map_, chair, bear, kNow, 0);
  EXPECT_EQ(KindsToldIn(map_), std::vector{Kind::kReplaced});
  list_.OnDisplaced(map_, cup, bear, kNow, 0);
  EXPECT_EQ(KindsToldIn(map_), (std::vector{Kind::kReplaced, Kind::kRemoved}));
}

TEST_F(ChangeListTest, TellsAMoveOnceTheNewThingIsKnownByItsColours) {
  const ObjectId chair = AddObject(kHere, 0, 5);
  const ObjectId other = AddObject(kThere, 8, 12, kChairClass, 5.0F);  // half hidden at first
  Leave(chair);
  Arrive(other);
  ASSERT_EQ(KindsToldIn(map_), (std::vector{Kind::kRemoved, Kind::kAdded}));
  MapObject known = *map_.FindObject(other);
  known.colours = map_.FindObject(chair)->colours;
  map_.SetObject(known);
  const Stamp later{12'000'000'000LL};
  list_.OnSeenAgain(map_, other, later);
  ASSERT_EQ(KindsToldIn(map_), std::vector{Kind::kMoved});
  EXPECT_EQ(map_.changes()[0].reported, later);
}

TEST_F(ChangeListTest, TakesTheRemovalOfASecondDisplacedThingBack) {
  const ObjectId chair = AddObject(kHere, 0, 5);
  const ObjectId cup = AddObject(kHere, 0, 5, 41, 1.0F, 0.1);
  const ObjectId bear = AddObject(kHere, 8, 9, kBearClass, 5.0F);
  Displace(chair, bear);
  Displace(cup, bear);
  ASSERT_EQ(KindsToldIn(map_), (std::vector{Kind::kReplaced, Kind::kRemoved}));
  list_.OnArrived(map_, cup, kNow, session_);
  EXPECT_EQ(KindsToldIn(map_), std::vector{Kind::kReplaced});
}

TEST_F(ChangeListTest, TakesAReplacementBackWhenTheOldThingIsSeenBesideTheNewOne) {
  const ObjectId chair = AddObject(kHere, 0, 5);
  const ObjectId bear = AddObject(kHere, 8, 9, kBearClass, 5.0F);
  Displace(chair, bear);
  ASSERT_EQ(KindsToldIn(map_), std::vector{Kind::kReplaced});
  list_.OnArrived(map_, chair, Stamp{10'000'000'000LL}, session_);
  EXPECT_EQ(KindsToldIn(map_), std::vector{Kind::kAdded}) << "the bear's place had been empty";
  EXPECT_EQ(map_.changes()[0].object, bear);
}

TEST_F(ChangeListTest, KeepsAReplacementWhenTheOldThingIsBackMuchLater) {
  const ObjectId chair = AddObject(kHere, 0, 5);
  const ObjectId bear = AddObject(kHere, 8, 9, kBearClass, 5.0F);
  Displace(chair, bear);
  list_.OnArrived(map_, chair, Stamp{60'000'000'000LL}, session_);
  EXPECT_EQ(KindsToldIn(map_), (std::vector{Kind::kReplaced, Kind::kAdded}));
}

TEST_F(ChangeListTest, GivesTheReplacementToTheLargerOfTwoThatAreGone) {
  const ObjectId small = AddObject(kHere, 0, 5, 41, 1.0F, 0.1);
  const ObjectId chair = AddObject(kHere, 0, 5);
  Leave(small);
  Arrive(AddObject(kHere, 8, 12, kBearClass, 5.0F));
  ASSERT_EQ(KindsToldIn(map_), std::vector{Kind::kReplaced});
  Leave(chair);
  ASSERT_EQ(KindsToldIn(map_), (std::vector{Kind::kReplaced, Kind::kRemoved}));
  EXPECT_EQ(map_.changes()[0].object, chair);
  EXPECT_EQ(map_.changes()[1].object, small);
}

TEST_F(ChangeListTest, TellsTwoMovesOfThingsThatChangedPlacesWhicheverIsMissedFirst) {
  const ObjectId chair = AddObject(kHere, 0, 5);
  const ObjectId bear = AddObject(kThere, 0, 5, kBearClass, 5.0F);
  Leave(chair);
  Arrive(AddObject(kHere, 8, 12, kBearClass, 5.0F));
  ASSERT_EQ(KindsToldIn(map_), std::vector{Kind::kReplaced}) << "as far as is known by then";
  Arrive(AddObject(kThere, 9, 12));
  ASSERT_EQ(KindsToldIn(map_), (std::vector{Kind::kMoved, Kind::kAdded}));
  Leave(bear);
  ASSERT_EQ(KindsToldIn(map_), (std::vector{Kind::kMoved, Kind::kMoved}));
  EXPECT_EQ(map_.changes()[0].object, chair);
  EXPECT_EQ(map_.changes()[1].object, bear);
}

TEST_F(ChangeListTest, ForgetsMovesOfAThingToItselfWhenTwoBecomeOne) {
  const ObjectId old_one = AddObject(kHere, 0, 5);
  const ObjectId new_one = AddObject(kThere, 8, 12);
  Leave(old_one);
  Arrive(new_one);
  ASSERT_EQ(KindsToldIn(map_), std::vector{Kind::kMoved});
  list_.OnMerged(map_, old_one, new_one);
  EXPECT_TRUE(map_.changes().empty());
}

TEST_F(ChangeListTest, TellsOneArrivalOfAThingThatWasTakenForTwo) {
  const ObjectId chair = AddObject(kHere, 8, 12);
  const ObjectId twin = AddObject(kHere, 9, 12);
  Arrive(chair);
  Arrive(twin);
  ASSERT_EQ(KindsToldIn(map_), (std::vector{Kind::kAdded, Kind::kAdded}));
  list_.OnMerged(map_, chair, twin);
  EXPECT_EQ(KindsToldIn(map_), std::vector{Kind::kAdded});
}

TEST_F(ChangeListTest, LeavesOneMoveToAThingThatWasTakenForTwo) {
  const ObjectId chair = AddObject(kHere, 0, 5);
  const ObjectId bear = AddObject(kHere, 0, 5, kBearClass, 5.0F);
  const ObjectId new_chair = AddObject(kThere, 8, 12);
  const ObjectId new_bear = AddObject(kThere, 8, 12, kBearClass, 5.0F);
  Leave(chair);
  Arrive(new_chair);
  Leave(bear);
  Arrive(new_bear);
  ASSERT_EQ(KindsToldIn(map_), (std::vector{Kind::kMoved, Kind::kMoved}));
  list_.OnMerged(map_, new_chair, new_bear);
  ASSERT_EQ(KindsToldIn(map_), (std::vector{Kind::kMoved, Kind::kRemoved}));
  EXPECT_EQ(map_.changes()[0].object, chair);
}

TEST_F(ChangeListTest, MarksRemovalsOfThingsOfEarlierSessions) {
  session_ = 1;
  Leave(AddObject(kHere, 0, 5));
  EXPECT_TRUE(map_.changes()[0].is_between_sessions);
}

}  // namespace
}  // namespace cslam
