// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/views_before.h"

#include "cslam/mapping/test_watched_room.h"

namespace cslam {
namespace {

using LookBackTest = test::WatchedRoomTest;

const Eigen::Vector3d kHere(0.0, 0.0, 2.0);

TEST_F(LookBackTest, CountsViewsOfAnEmptyPlace) {
  const ObjectId chair = AddObject(kHere, 7, 9);
  const ViewsBefore before = LookBack(map_, *map_.FindObject(chair), camera_, 0, options_.view);
  EXPECT_EQ(before.num_through, 7);
  EXPECT_EQ(before.num_standing, 0);
  EXPECT_FALSE(before.is_between_sessions);
}

TEST_F(LookBackTest, SeesThatSomethingStoodThereBefore) {
  const ObjectId poster = AddObject({0.0, 0.0, 3.25}, 7, 9);  // its front is the wall
  const ViewsBefore before = LookBack(map_, *map_.FindObject(poster), camera_, 0, options_.view);
  EXPECT_EQ(before.num_through, 0);
  EXPECT_EQ(before.num_standing, 7);
}

TEST_F(LookBackTest, TellsSessionsApart) {
  map_.StartSession();  // begins with keyframe 20
  const ObjectId chair = AddObject(kHere, 20, 21);
  const ViewsBefore before = LookBack(map_, *map_.FindObject(chair), camera_, 1, options_.view);
  EXPECT_EQ(before.num_through, 20);
  EXPECT_TRUE(before.is_between_sessions);
}

}  // namespace
}  // namespace cslam
