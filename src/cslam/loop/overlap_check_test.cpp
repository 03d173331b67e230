// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/overlap_check.h"

#include "cslam/map/test_room.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

constexpr int kRoomPoints = 1500;

PlaceSensor RoomSensor() {
  const Camera camera = test::RoomCamera();
  return {camera, UndistortedBounds(camera), test::kRoomBaselineM,
          MeasurementModel(test::kRoomScales, 1.0)};
}

void AddViews(test::RoomMapper& mapper, MapId map, double first_turn) {
  KeyframeId last;
  for (int i = 0; i < 6; ++i) {
    const Se3 T = test::CirclePose(first_turn + 0.03 * i);
    last = mapper.Add(T, T, last, map);
  }
}

OverlapComparison Compare(test::RoomMapper& mapper) {
  const CorrectedView view(mapper.map(), {});
  return CompareOverlap(view, MapId(1), MapId(0), RoomSensor(), {}, {});
}

TEST(CompareOverlap, AgreesWhereBothMapsShowOneRoom) {
  test::RoomMapper mapper(test::MakeRoom(kRoomPoints, 3));
  AddViews(mapper, MapId(0), 0.0);
  AddViews(mapper, MapId(1), 0.04);
  const OverlapComparison overlap = Compare(mapper);
  EXPECT_GE(overlap.num_agreeing, 4);
  EXPECT_EQ(overlap.num_contradicting, 0);
  EXPECT_EQ(WhyContradicted(overlap, OverlapCheckOptions{}), "");
}

TEST(CompareOverlap, ContradictsWhereTheRoomsDiffer) {
  test::RoomMapper mapper(test::MakeRoom(kRoomPoints, 3));
  AddViews(mapper, MapId(0), 0.0);
  mapper.room() = test::MakeRoom(kRoomPoints, 4);
  AddViews(mapper, MapId(1), 0.04);
  const OverlapComparison overlap = Compare(mapper);
  EXPECT_GE(overlap.num_contradicting, 4);
  EXPECT_NE(WhyContradicted(overlap, OverlapCheckOptions{}).find("see something else"),
            std::string::npos);
}

TEST(CompareOverlap, SaysNothingOfMapsThatLookElsewhere) {
  test::RoomMapper mapper(test::MakeRoom(kRoomPoints, 3));
  AddViews(mapper, MapId(0), 0.0);
  AddViews(mapper, MapId(1), 0.5);
  const OverlapComparison overlap = Compare(mapper);
  EXPECT_EQ(overlap.num_compared(), 0);
  EXPECT_EQ(WhyContradicted(overlap, OverlapCheckOptions{}), "");
}

}  // namespace
}  // namespace cslam
