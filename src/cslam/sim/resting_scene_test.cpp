// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/resting_scene.h"

#include "cslam/sim/resting_cache.h"
#include "cslam/sim/room.h"
#include "cslam/sim/test_world.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

// The room, from which a cup, the chair and a carton go, stay and move at 1 s.
World MakeChangingRoom() {
  World world{MakeRoom({.texels_per_m = 30.0, .light_cell_m = 0.3}), {}, {}};
  const std::vector<SceneObject>& objects = world.scene.objects;
  const auto find = [&](int class_id) {
    const auto at = std::ranges::find(objects, class_id, &SceneObject::class_id);
    return static_cast<int>(at - objects.begin());
  };
  const int chair = find(56);
  const int couch = find(57);
  const Se3 T_chair = objects[static_cast<std::size_t>(chair)].T_world_object;
  world.timelines[chair].stays = {
      {.to_s = 1.0, .T_world_object = T_chair},
      {.from_s = 1.0, .T_world_object = Standing(0.4, 0.3, 0.0, 0.7) * T_chair}};
  world.timelines[couch].stays = {
      {.to_s = 1.0, .T_world_object = objects[static_cast<std::size_t>(couch)].T_world_object}};
  return world;
}

TEST(RestingScene, BakesTheSameLightFromAnotherTimeAsFromNothing) {
  const World world = MakeChangingRoom();
  const RestingScene before(world, 0.0);
  const RestingScene from_nothing(world, 2.0);
  const RestingScene from_before(world, 2.0, &before);
  int num_changed = 0;
  for (int i = 0; i < static_cast<int>(world.scene.objects.size()); ++i) {
    EXPECT_EQ(from_before.irradiance(i), from_nothing.irradiance(i)) << "object " << i;
    num_changed += from_nothing.irradiance(i) != before.irradiance(i) ? 1 : 0;
  }
  EXPECT_GT(num_changed, 3) << "the change must be seen in the light of others";
}

TEST(RestingScene, LeavesOutWhatIsAwayOrMoves) {
  const World world = test::MakeTestWorld();
  EXPECT_TRUE(RestingScene(world, 0.0).facets().Has(test::kBox));
  EXPECT_FALSE(RestingScene(world, 3.0).facets().Has(test::kBox));
  EXPECT_FALSE(RestingScene(world, 7.0).facets().Has(test::kBox));
  EXPECT_FALSE(RestingScene(world, 3.0).facets().Has(test::kBody));
}

TEST(RestingCache, GivesOneSceneForTheWholeTimeBetweenChanges) {
  const World world = test::MakeTestWorld();
  const RestingCache cache(world);
  const auto first = cache.At(0.0);
  EXPECT_EQ(cache.At(1.999), first);
  EXPECT_NE(cache.At(2.0), first);
  EXPECT_NE(cache.At(5.0), cache.At(6.0));
  EXPECT_EQ(cache.At(6.0), cache.At(100.0));
}

}  // namespace
}  // namespace cslam
