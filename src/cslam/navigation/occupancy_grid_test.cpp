// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/navigation/occupancy_grid.h"

#include "cslam/map/test_room.h"
#include "cslam/util/check.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

using test::RoomMapper;
using test::TestRoom;

// A room of 6 x 6 m with a table-high box; y is down, the floor at y = 1.3 m.
const test::TestBox kThing{{1.0, 0.5, 1.5}, {1.6, 1.3, 2.1}};

TestRoom RoomWith(std::vector<test::TestBox> things) {
  TestRoom room = test::MakeRoom(200, 3);
  room.things = std::move(things);
  return room;
}

void LookAround(RoomMapper& mapper) {
  KeyframeId last =
      mapper.map().num_keyframe_ids() == 0
          ? KeyframeId()
          : KeyframeId(static_cast<std::uint32_t>(mapper.map().num_keyframe_ids()) - 1);
  for (int i = 0; i < 20; ++i) {
    const Se3 pitch(ExpSo3({-0.45, 0.0, 0.0}), Eigen::Vector3d::Zero());
    const Se3 pose = test::CirclePose(i / 20.0, 0.3) * pitch;
    last = mapper.Add(pose, pose, last);
  }
}

// Where a point of the room is in the grid.
Eigen::Vector2d At(const OccupancyGrid& grid, double x, double z) {
  return (grid.T_grid_world * Eigen::Vector3d(x, 1.3, z)).head<2>();
}

OccupancyGrid Build(const RoomMapper& mapper, std::span<const ClearedRegion> cleared = {}) {
  RoomMapper copy = mapper;
  return BuildOccupancyGrid(copy.map(), MapId(0), mapper.camera(), cleared, {.max_depth_m = 6.0})
      .value();
}

TEST(BuildOccupancyGrid, HasWallsAndThingsOccupiedAndTheFloorFree) {
  RoomMapper mapper(RoomWith({kThing}));
  LookAround(mapper);

  const OccupancyGrid grid = Build(mapper);

  EXPECT_TRUE(grid.has_floor);
  EXPECT_NEAR((grid.T_grid_world * Eigen::Vector3d(0.5, 1.3, 0.5)).z(), 0.0, 0.02);
  EXPECT_EQ(grid.At(At(grid, 0.0, 2.0)), CellState::kFree);
  EXPECT_EQ(grid.At(At(grid, -1.5, 0.5)), CellState::kFree);
  EXPECT_EQ(grid.At(At(grid, 1.3, 1.52)), CellState::kOccupied);
  EXPECT_EQ(grid.At(At(grid, -3.0, 0.0)), CellState::kOccupied);
  EXPECT_EQ(grid.At(At(grid, -3.5, 0.0)), CellState::kUnknown);
  EXPECT_EQ(grid.At(At(grid, 9.0, 9.0)), CellState::kUnknown);
}

TEST(BuildOccupancyGrid, HasTheWholeTopOfATableSeenAtAFlatAngle) {
  const test::TestBox table{{0.8, 0.55, 0.9}, {2.6, 1.3, 2.7}};
  RoomMapper mapper(RoomWith({table}));
  LookAround(mapper);

  const OccupancyGrid grid = Build(mapper);

  int occupied = 0;
  int free = 0;
  for (double x = 0.85; x < 2.6; x += 0.05) {
    for (double z = 0.95; z < 2.7; z += 0.05) {
      const CellState state = grid.At(At(grid, x, z));
      occupied += state == CellState::kOccupied ? 1 : 0;
      free += state == CellState::kFree ? 1 : 0;
    }
  }
  EXPECT_GT(occupied, 900);  // of 1225
  EXPECT_LT(free, 60);
}

TEST(BuildOccupancyGrid, LeavesOutWhatIsKnownToBeGone) {
  RoomMapper mapper(RoomWith({kThing}));
  LookAround(mapper);
  const ClearedRegion gone{.T_world_box = {Eigen::Quaterniond::Identity(), {1.3, 0.9, 1.8}},
                           .size_m = {0.6, 0.8, 0.6}};

  const OccupancyGrid grid = Build(mapper, std::span(&gone, 1));

  EXPECT_NE(grid.At(At(grid, 1.3, 1.52)), CellState::kOccupied);
  EXPECT_EQ(grid.At(At(grid, -3.0, 0.0)), CellState::kOccupied);
}

TEST(BuildOccupancyGrid, KeepsWhatStandsWhereSomethingWentBefore) {
  RoomMapper mapper(RoomWith({kThing}));
  LookAround(mapper);
  LookAround(mapper);
  const ClearedRegion gone{.T_world_box = {Eigen::Quaterniond::Identity(), {1.3, 0.9, 1.8}},
                           .size_m = {0.6, 0.8, 0.6},
                           .last_seen = KeyframeId(19)};

  const OccupancyGrid grid = Build(mapper, std::span(&gone, 1));

  EXPECT_EQ(grid.At(At(grid, 1.3, 1.52)), CellState::kOccupied);
}

TEST(BuildOccupancyGrid, ClearsWhatIsSeenThroughLater) {
  RoomMapper mapper(RoomWith({kThing}));
  LookAround(mapper);
  mapper.room().things.clear();
  for (int i = 0; i < 4; ++i)
    LookAround(mapper);

  const OccupancyGrid grid = Build(mapper);

  EXPECT_EQ(grid.At(At(grid, 1.3, 1.52)), CellState::kFree);
}

TEST(BuildOccupancyGrid, HasNoneWithoutDepthAndRefusesOneThatIsTooLarge) {
  RoomMapper mapper(RoomWith({}));
  EXPECT_FALSE(BuildOccupancyGrid(mapper.map(), MapId(0), mapper.camera(), {}, {}).has_value());
  LookAround(mapper);
  EXPECT_THROW(BuildOccupancyGrid(mapper.map(), MapId(0), mapper.camera(), {},
                                  {.resolution_m = 0.001, .layer_m = 0.01}),
               Error);
}

}  // namespace
}  // namespace cslam
