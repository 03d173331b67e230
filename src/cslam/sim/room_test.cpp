// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/room.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace cslam {
namespace {

constexpr RoomOptions kCoarse{.seed = 1, .texels_per_m = 60.0, .light_cell_m = 0.5};

TEST(MakeRoom, IsAConsistentSceneWithTheRoomAsInstanceZero) {
  const Scene room = MakeRoom(kCoarse);
  EXPECT_NO_THROW(CheckScene(room));
  ASSERT_FALSE(room.objects.empty());
  EXPECT_EQ(room.objects.front().name, "room");
  const auto count = [&](std::string_view name) {
    return std::ranges::count(room.objects, name, &SceneObject::name);
  };
  EXPECT_GE(count("book"), 50);
  EXPECT_EQ(count("monitor"), 3);
  EXPECT_EQ(count("desk"), 2);
}

TEST(MakeRoom, KeepsEverythingInsideTheWalls) {
  const Scene room = MakeRoom(kCoarse);
  for (const SceneObject& object : room.objects) {
    for (const Eigen::Vector3f& p : object.mesh.positions) {
      const Eigen::Vector3d q = object.T_world_object * p.cast<double>();
      EXPECT_TRUE(q.x() > -0.02 && q.x() < 6.02 && q.y() > -0.02 && q.y() < 5.02 && q.z() > -0.02 &&
                  q.z() < 2.72)
          << object.name << " at " << q.transpose();
    }
  }
}

TEST(MakeRoom, LeavesTheMiddleFreeForTheCameraWhateverTheSeed) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    RoomOptions options = kCoarse;
    options.seed = seed;
    const Scene room = MakeRoom(options);
    for (const SceneObject& object : room.objects) {
      for (const Eigen::Vector3f& p : object.mesh.positions) {
        const Eigen::Vector3d q = object.T_world_object * p.cast<double>();
        const bool in_the_way =
            q.x() > 1.5 && q.x() < 4.5 && q.y() > 1.3 && q.y() < 3.7 && q.z() > 1.1 && q.z() < 2.6;
        EXPECT_FALSE(in_the_way) << object.name << " at " << q.transpose();
      }
    }
  }
}

}  // namespace
}  // namespace cslam
