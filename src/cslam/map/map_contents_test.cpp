// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/map/map_contents.h"

#include "cslam/map/test_map.h"
#include "cslam/util/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

namespace cslam {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

const KeyframeId k0(0), k1(1), k2(2);

// Three keyframes and a culled one, points seen by many, one fused, one erased.
Map MakeTestMap() {
  Map map(test::kLevelScales);
  map.AddKeyframe(test::MakeKeyframe(0, 20));
  map.AddKeyframe(test::MakeKeyframe(1, 20, 1.0, k0));
  map.AddKeyframe(test::MakeKeyframe(2, 20, 2.0, k1));
  map.AddKeyframe(test::MakeKeyframe(4, 20, 3.0, k1));
  for (int i = 0; i < 10; ++i) {
    const PointId point = map.AddPoint({0.1 * i, 0.0, 3.0}, k0);
    for (const KeyframeId id : {k0, k1, k2})
      map.AddObservation(point, id, i);
    map.RefreshAppearance(point);
  }
  const PointId twin = map.AddPoint({0.0, 0.0, 3.0}, k2);
  map.AddObservation(twin, k2, 15);
  map.FusePoints(PointId(3), twin);
  map.ErasePoint(PointId(9));
  map.CullKeyframe(k1);
  return map;
}

MapContents ContentsOf(const Map& map) {
  MapContents contents;
  contents.level_scales = map.level_scales();
  for (std::size_t i = 0; i < map.num_keyframe_ids(); ++i)
    contents.keyframes.push_back(map.KeyframeSlot(i));
  for (std::size_t i = 0; i < map.num_point_ids(); ++i)
    contents.points.push_back(map.PointSlot(i));
  return contents;
}

std::string MessageFor(const std::function<void(MapContents&)>& damage) {
  MapContents contents = ContentsOf(MakeTestMap());
  damage(contents);
  try {
    const Map map(std::move(contents));
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(MapContents, GiveTheSameMapAgain) {
  const Map map = MakeTestMap();
  MapContents contents = ContentsOf(map);
  for (Keyframe& keyframe : contents.keyframes)
    keyframe.covisible.clear();
  for (MapPoint& point : contents.points)
    point.observations.clear();
  const Map again(std::move(contents));
  EXPECT_THAT(again.CheckInvariants(), IsEmpty());
  EXPECT_EQ(again.num_keyframes(), 3U);
  EXPECT_EQ(again.num_points(), 9U);
  EXPECT_EQ(again.num_keyframe_ids(), 5U);
  EXPECT_EQ(again.num_point_ids(), 11U);
  EXPECT_EQ(again.Resolve(PointId(10)), PointId(3));
  EXPECT_EQ(again.Resolve(PointId(9)), std::nullopt);
  EXPECT_EQ(again.Resolve(k1)->keyframe, k0);
  EXPECT_EQ(again.FindPoint(PointId(3))->observations, map.FindPoint(PointId(3))->observations);
  EXPECT_EQ(again.FindKeyframe(k2)->covisible, map.FindKeyframe(k2)->covisible);
}

TEST(MapContents, AreRefusedWhenIdsLeadNowhere) {
  EXPECT_THAT(MessageFor([](auto& c) { c.keyframes[0].points[0] = PointId(99); }),
              HasSubstr("sees point 99"));
  EXPECT_THAT(MessageFor([](auto& c) { c.keyframes[0].points[0] = PointId(9); }),
              HasSubstr("which is gone"));
  EXPECT_THAT(MessageFor([](auto& c) { c.keyframes[2].parent = KeyframeId(99); }),
              HasSubstr("parent"));
  EXPECT_THAT(MessageFor([](auto& c) { c.keyframes[1].forward_to = KeyframeId(99); }),
              HasSubstr("never was"));
  EXPECT_THAT(MessageFor([](auto& c) { c.points[10].replaced_by = PointId(); }),
              HasSubstr("never was"));
  EXPECT_THAT(MessageFor([](auto& c) { c.points[0].reference = KeyframeId(99); }),
              HasSubstr("belongs to nothing"));
}

TEST(MapContents, AreRefusedWhenSomethingGoesInACircle) {
  EXPECT_THAT(MessageFor([](auto& c) { c.points[10].replaced_by = PointId(10); }),
              HasSubstr("in a circle"));
  EXPECT_THAT(MessageFor([](auto& c) { c.keyframes[1].forward_to = k1; }),
              HasSubstr("in a circle"));
  EXPECT_THAT(MessageFor([](auto& c) {
                c.keyframes[3].forward_to = k1;
                c.keyframes[1].forward_to = KeyframeId(3);
              }),
              HasSubstr("in a circle"));
  EXPECT_THAT(MessageFor([](auto& c) { c.keyframes[0].parent = k2; }), HasSubstr("cycle"));
}

TEST(MapContents, AreRefusedWhenArraysAreUneven) {
  EXPECT_THAT(MessageFor([](auto& c) { c.keyframes[0].points.pop_back(); }),
              HasSubstr("unequal length"));
  EXPECT_THAT(MessageFor([](auto& c) { c.keyframes[0].points[19] = PointId(0); }),
              HasSubstr("twice"));
  EXPECT_THAT(MessageFor([](auto& c) { c.level_scales.resize(1); }), HasSubstr("level"));
  EXPECT_THAT(MessageFor([](auto& c) { c.level_scales.clear(); }), HasSubstr("scales"));
  EXPECT_THAT(MessageFor([](auto& c) { c.points[0].state = PointState(7); }), HasSubstr("state"));
}

TEST(MapContents, AreRefusedWhenNumbersAreNone) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(MessageFor([](auto& c) { c.points[0].max_distance_m = kNan; }),
              HasSubstr("not finite"));
  EXPECT_THAT(MessageFor([](auto& c) { c.points[0].normal.x() = kNan; }), HasSubstr("not finite"));
}

// One number of the contents becomes another, small enough to mean something.
void Damage(MapContents& contents, Rng& rng) {
  const auto value = static_cast<std::uint32_t>(rng.Index(14) == 0 ? 99 : rng.Index(12));
  Keyframe& keyframe = contents.keyframes[rng.Index(contents.keyframes.size())];
  MapPoint& point = contents.points[rng.Index(contents.points.size())];
  switch (rng.Index(10)) {
    case 0:
      keyframe.parent = KeyframeId(value);
      break;
    case 1:
      keyframe.forward_to = KeyframeId(value);
      break;
    case 2:
      keyframe.map = MapId(value % 2);
      break;
    case 3:
      keyframe.id = KeyframeId(value);
      break;
    case 4:
      point.replaced_by = PointId(value);
      break;
    case 5:
      point.reference = KeyframeId(value);
      break;
    case 6:
      point.state = PointState(value % 4);
      break;
    case 7:
      point.map = MapId(value % 2);
      break;
    case 8:
      keyframe.data = nullptr;
      break;
    default:
      if (!keyframe.points.empty()) keyframe.points[value % 20] = PointId(value);
  }
}

TEST(MapContents, AreRefusedOrSoundWhateverIsInThem) {
  const MapContents sound = ContentsOf(MakeTestMap());
  Rng rng(3);
  int num_refused = 0;
  constexpr int kNumRounds = 3000;
  for (int round = 0; round < kNumRounds; ++round) {
    MapContents contents = sound;
    for (std::uint64_t i = 0; i <= rng.Index(3); ++i)
      Damage(contents, rng);
    try {
      const Map map(std::move(contents));
      EXPECT_THAT(map.CheckInvariants(), IsEmpty());
      for (std::uint32_t id = 0; id < 12; ++id) {
        static_cast<void>(map.Resolve(PointId(id)));
        static_cast<void>(map.T_world_keyframe(KeyframeId(id)));
      }
    } catch (const Error&) {
      ++num_refused;
    }
  }
  EXPECT_GT(num_refused, kNumRounds / 4);
  EXPECT_LT(num_refused, kNumRounds);
}

}  // namespace
}  // namespace cslam
