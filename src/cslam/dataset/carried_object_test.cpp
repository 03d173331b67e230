// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/carried_object.h"

#include "cslam/util/check.h"

#include <gtest/gtest.h>

#include <memory>

namespace cslam {
namespace {

std::shared_ptr<const PersonMotion> Holder() {
  return Carrying(
      Walk({{0.0, {0.0, 0.0}}, {3.0, {0.0, 0.0}}, {6.0, {3.0, 0.0}}, {9.0, {3.0, 0.0}}}, 1), 1.0,
      8.0);
}

TEST(TakenOnce, LeadsFromPlaceToPlaceThroughTheHandsWithoutJumps) {
  const auto holder = Holder();
  const Errand errand{1.0, 8.0, Standing(0.5, 0.0, 0.0), Standing(3.5, 0.0, 0.4, 1.0)};
  const Timeline timeline = TakenOnce(*holder, errand);
  EXPECT_EQ(StateAt(timeline, 0.9).presence, Presence::kResting);
  EXPECT_EQ(StateAt(timeline, 1.0).presence, Presence::kMoving);
  EXPECT_EQ(StateAt(timeline, 8.0).presence, Presence::kResting);
  EXPECT_LT(
      Difference(StateAt(timeline, 4.5).T_world_object, T_world_Carried(*holder, 4.5)).distance_m,
      0.01);
  for (double t = 0.8; t < 8.2; t += 0.02) {
    const PoseDifference step =
        Difference(StateAt(timeline, t).T_world_object, StateAt(timeline, t + 0.02).T_world_object);
    EXPECT_LT(step.distance_m, 0.06) << "at " << t;  // 3 m/s
  }
}

TEST(TakenOnce, RefusesAnErrandTooShortToLiftAnything) {
  const auto holder = Holder();
  EXPECT_THROW(TakenOnce(*holder, {1.0, 2.0, Se3(), Se3()}), InternalError);
}

TEST(MovedAt, SwitchesPlacesAsRemovedAtAndAddedAtDo) {
  const Se3 here = Standing(1.0, 0.0, 0.0);
  const Se3 there = Standing(2.0, 0.0, 0.0);
  EXPECT_EQ(StateAt(MovedAt(5.0, here, there), 4.9).T_world_object.translation.x(), 1.0);
  EXPECT_EQ(StateAt(MovedAt(5.0, here, there), 5.0).T_world_object.translation.x(), 2.0);
  EXPECT_EQ(StateAt(RemovedAt(5.0, here), 5.0).presence, Presence::kAway);
  EXPECT_EQ(StateAt(AddedAt(5.0, here), 4.9).presence, Presence::kAway);
  EXPECT_EQ(StateAt(AddedAt(5.0, here), 5.0).presence, Presence::kResting);
}

}  // namespace
}  // namespace cslam
