// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/world.h"

#include "cslam/sim/test_scene.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

// Rests at x = 0 until 2 s, is carried to x = 3 until 4 s with a stop over x = 1 at 3 s, rests
// there until 6 s, and comes back to x = 5 at 8 s.
Timeline MakeTimeline() {
  Timeline timeline;
  timeline.stays = {{.to_s = 2.0, .T_world_object = Standing(0.0, 0.0, 0.0)},
                    {.from_s = 4.0, .to_s = 6.0, .T_world_object = Standing(3.0, 0.0, 0.0)},
                    {.from_s = 8.0, .T_world_object = Standing(5.0, 0.0, 0.0)}};
  timeline.carries = {{{2.0, Standing(0.0, 0.0, 0.0)},
                       {3.0, Standing(1.0, 0.0, 0.0)},
                       {4.0, Standing(3.0, 0.0, 0.0)}}};
  return timeline;
}

void ExpectAt(double time_s, Presence presence, double x_m) {
  const Placement state = StateAt(MakeTimeline(), time_s);
  EXPECT_EQ(state.presence, presence) << time_s << " s";
  EXPECT_NEAR(state.T_world_object.translation.x(), x_m, 1e-12) << time_s << " s";
}

TEST(StateAt, RestsMovesAndRestsAgain) {
  ExpectAt(-1e9, Presence::kResting, 0.0);
  ExpectAt(1.999, Presence::kResting, 0.0);
  ExpectAt(2.5, Presence::kMoving, 0.5);
  ExpectAt(3.0, Presence::kMoving, 1.0);
  ExpectAt(3.5, Presence::kMoving, 2.0);
  ExpectAt(5.0, Presence::kResting, 3.0);
  ExpectAt(1e9, Presence::kResting, 5.0);
}

TEST(StateAt, BelongsToTheNextStretchAtItsFirstMoment) {
  ExpectAt(2.0, Presence::kMoving, 0.0);
  ExpectAt(4.0, Presence::kResting, 3.0);
  ExpectAt(8.0, Presence::kResting, 5.0);
}

TEST(StateAt, IsAwayWhenNothingHolds) {
  EXPECT_EQ(StateAt(MakeTimeline(), 6.0).presence, Presence::kAway);
  EXPECT_EQ(StateAt(MakeTimeline(), 7.9).presence, Presence::kAway);
  EXPECT_EQ(StateAt(Timeline{}, 0.0).presence, Presence::kAway);
}

TEST(StateAt, LeavesObjectsWithoutTimelineWhereTheSceneHasThem) {
  World world{MakeTestScene(), {}, {}};
  world.timelines[0] = Timeline{};
  EXPECT_EQ(StateAt(world, 0, 1.0).presence, Presence::kAway);
  EXPECT_EQ(StateAt(world, 1, 1.0).presence, Presence::kResting);
  EXPECT_NEAR(StateAt(world, 1, 1.0).T_world_object.translation.y(), 2.0, 1e-12);
}

TEST(TimesOfChange, ListsEveryStartAndEndOnce) {
  World world;
  world.timelines[3] = MakeTimeline();
  world.timelines[5].stays = {{.from_s = 1.0, .to_s = 4.0, .T_world_object = Se3()}};
  EXPECT_EQ(TimesOfChange(world), (std::vector<double>{1.0, 2.0, 4.0, 6.0, 8.0}));
  EXPECT_TRUE(TimesOfChange(World{}).empty());
}

TEST(WithoutObjects, KeepsTheOthersWithWhatTheyDo) {
  World world;
  world.scene.objects = {{"room", kNoClass, {}, {}},
                         {"first", 0, {}, {}},
                         {"box", 28, {}, {}},
                         {"second", 0, {}, {}},
                         {"dog", 16, {}, {}}};
  world.timelines[2] = MakeTimeline();
  for (const int id : {1, 3, 4})
    world.animations[id] = [id](double) {
      return BodyShape{std::vector<Eigen::Vector3f>(static_cast<std::size_t>(id)), {}, {}};
    };
  const World rest =
      WithoutObjects(world, [](const SceneObject& object) { return object.class_id == 0; });
  ASSERT_EQ(rest.scene.objects.size(), 3U);
  EXPECT_EQ(rest.scene.objects[1].name, "box");
  EXPECT_EQ(rest.scene.objects[2].name, "dog");
  EXPECT_EQ(StateAt(rest, 1, 2.5).presence, Presence::kMoving);
  ASSERT_EQ(rest.animations.size(), 1U);
  EXPECT_EQ(rest.animations.at(2)(0.0)->positions.size(), 4U);
}

}  // namespace
}  // namespace cslam
