// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/scene_eval/map_hygiene.h"

#include "cslam/scene_eval/test_scene.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace cslam {
namespace {

using test::kLeft;

const Eigen::Vector3d kFront(-0.8, 0.0, 2.8);  // of the box there, as the camera sees it

test::TestWorld ChairLeaves() {
  test::TestWorld world;
  world.duration_s = 3.0;
  world.stays = {{.instance = 1, .to_s = 1.0, .center = kLeft}};
  return world;
}

GhostCount Count(const test::TestWorld& world, std::vector<Eigen::Vector3d> points) {
  test::TestScene scene(world);
  scene.run.map_points = std::move(points);
  return CountGhosts(scene.truth, scene.run);
}

TEST(CountGhosts, FindsPointsOfWhatIsGone) {
  const Eigen::Vector3d on_the_wall(0.5, 0.0, test::kWallM);
  const GhostCount count = Count(ChairLeaves(), {kFront, on_the_wall});
  EXPECT_EQ(count.num_former_places, 1);
  ASSERT_EQ(count.ghosts.size(), 1U);
  EXPECT_EQ(count.ghosts[0], kFront);
  EXPECT_EQ(count.Share(), 0.5);
}

TEST(CountGhosts, SparesPointsOfWhatIsStillThere) {
  test::TestWorld world = ChairLeaves();
  world.stays[0].to_s = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(Count(world, {kFront}).ghosts.empty());
}

TEST(CountGhosts, SparesPointsOfWhatStandsThereInstead) {
  test::TestWorld world = ChairLeaves();
  world.stays.push_back({.instance = 2, .from_s = 1.0, .center = kLeft});
  const GhostCount count = Count(world, {kFront});
  EXPECT_EQ(count.num_former_places, 1);
  EXPECT_TRUE(count.ghosts.empty());
}

TEST(CountGhosts, AsksOnlyForPlacesSeenAgain) {
  test::TestWorld world = ChairLeaves();
  world.yaw_rad = [](double time_s) { return time_s < 0.9 ? 0.0 : std::numbers::pi; };
  const GhostCount count = Count(world, {kFront});
  EXPECT_EQ(count.num_former_places, 0);
  EXPECT_TRUE(count.ghosts.empty());
}

TEST(CountGhosts, CountsAPointOfTwoFormerThingsOnce) {
  test::TestWorld world = ChairLeaves();
  world.stays.push_back({.instance = 2, .from_s = 1.0, .to_s = 2.0, .center = kLeft});
  const GhostCount count = Count(world, {kFront});
  EXPECT_EQ(count.num_former_places, 2);
  EXPECT_EQ(count.ghosts.size(), 1U);
}

TEST(CountGhosts, NeedsTheMap) {
  test::TestScene scene(ChairLeaves());
  scene.run.map_points.reset();
  EXPECT_THAT(MessageOf([&] { CountGhosts(scene.truth, scene.run); }),
              testing::HasSubstr("map.ply"));
}

TEST(ShareOfActivePoints, LooksAtSettledMatchedObjectsOnly) {
  ObjectEvaluation evaluation;
  JudgedObject settled{.found = test::Found(1, test::kChair, kLeft)};
  settled.verdict = ObjectVerdict::kMatched;
  settled.found.report.num_active_points = 8;
  JudgedObject fresh = settled;
  fresh.found.report.first_seen = test::StampAt(6.0);
  fresh.found.report.num_active_points = 0;
  JudgedObject wrong = settled;
  wrong.verdict = ObjectVerdict::kFalse;
  evaluation.objects = {settled, fresh, wrong};
  EXPECT_EQ(ShareOfActivePoints(evaluation, test::StampAt(10.0)).Share(), 0.8);
  EXPECT_FALSE(ShareOfActivePoints({}, test::StampAt(10.0)).Share());
}

}  // namespace
}  // namespace cslam
