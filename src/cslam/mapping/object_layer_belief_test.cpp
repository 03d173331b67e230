// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether a thing is there: how evidence moves beliefs, and what that makes of objects.
#include "cslam/mapping/object_layer.h"
#include "cslam/mapping/test_object_layer.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

using test::kPlace;
using test::ObjectLayerTest;
using test::PoseLookingAt;

TEST_F(ObjectLayerTest, BelievesInWhatIsSeenAgain) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  EXPECT_EQ(Object(0).state, ObjectState::kPresent);
  EXPECT_TRUE(Object(0).is_active);
  EXPECT_GE(BeliefOf(Object(0)), belief_.activate_at);
  EXPECT_TRUE(map_.changes().empty()) << "nobody had looked there before";
}

TEST_F(ObjectLayerTest, StaysPresentWhenNothingIsSeenOfIt) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  const double belief = BeliefOf(Object(0));
  for (int i = 0; i < 10; ++i)
    Insert(PoseLookingAt({0.0, 0.2, 0.0}, {0.0, 0.2, -2.0}));
  EXPECT_EQ(Object(0).state, ObjectState::kPresent);
  EXPECT_EQ(BeliefOf(Object(0)), belief);
  EXPECT_TRUE(map_.changes().empty());
}

TEST_F(ObjectLayerTest, ForgetsWhatIsHardlyEverNamedThoughItStandsInView) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  ASSERT_EQ(Object(0).state, ObjectState::kPresent);
  ObjectEvidence unnamed;
  unnamed.object = ObjectId(0);
  unnamed.num_missed = 10;
  Insert(front_, std::vector{unnamed});
  ASSERT_FALSE(map_.Objects().empty()) << "not yet";
  Insert(front_, std::vector{unnamed});
  EXPECT_EQ(map_.ObjectSlot(0).state, ObjectState::kErased);
  EXPECT_TRUE(map_.changes().empty()) << "it was never there, so it did not go";
}

TEST_F(ObjectLayerTest, TakesEvidenceForWhatIsMergedOrUnknown) {
  room_.things = {Chair(kPlace)};
  Insert(front_);
  EXPECT_NO_THROW(Insert(front_, std::vector{Through(ObjectId(99), 4), Seen(ObjectId(0))}));
  EXPECT_EQ(Object(0).state, ObjectState::kPresent);
}

TEST_F(ObjectLayerTest, UpdatesOncePerVisitWhenToldSo) {
  MapObjectOptions objects;
  objects.belief_update = "visit";
  objects.visit_gap_keyframes = 3;
  MakeLayer(objects);
  room_.things = {Chair(kPlace)};
  Settle(front_);
  ASSERT_EQ(Object(0).state, ObjectState::kPresent);
  room_.things.clear();
  Insert(front_, std::vector{Through(ObjectId(0), 4)});
  EXPECT_EQ(Object(0).state, ObjectState::kPresent) << "this visit has had its say";
  for (int i = 0; i < 3; ++i)
    Insert(front_);
  Insert(front_, std::vector{Through(ObjectId(0), 4)});
  EXPECT_EQ(Object(0).state, ObjectState::kAbsent);
}

TEST_F(ObjectLayerTest, DoesNothingWhenSwitchedOff) {
  MapObjectOptions objects;
  objects.enabled = false;
  MakeLayer(objects);
  room_.things = {Chair(kPlace)};
  EXPECT_EQ(Insert(front_).num_new, 0);
  EXPECT_TRUE(map_.Objects().empty());
}

}  // namespace
}  // namespace cslam
