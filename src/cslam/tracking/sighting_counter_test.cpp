// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/tracking/sighting_counter.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

std::vector<ExpectedPoint> Expected(const std::vector<std::uint32_t>& ids) {
  std::vector<ExpectedPoint> expected;
  for (const std::uint32_t id : ids) {
    ExpectedPoint point;
    point.point = PointId(id);
    point.query.uv_px.setZero();
    expected.push_back(point);
  }
  return expected;
}

FrameMatches Found(const std::vector<std::uint32_t>& ids) {
  FrameMatches matches(1);  // and a keypoint without any
  for (const std::uint32_t id : ids)
    matches.push_back({.kind = Landmark::Kind::kMapPoint, .point = PointId(id)});
  return matches;
}

TEST(SightingCounter, CountsWhatWasExpectedAndWhatWasFound) {
  SightingCounter counter;
  counter.Count(Expected({3, 5}), Found({5}), 6);
  counter.Count(Expected({5}), Found({5}), 6);
  const auto sightings = counter.Take();
  ASSERT_EQ(sightings.size(), 2U);
  EXPECT_EQ(sightings[0].point, PointId(3));
  EXPECT_EQ(sightings[0].expected, 1);
  EXPECT_EQ(sightings[0].found, 0);
  EXPECT_EQ(sightings[1].point, PointId(5));
  EXPECT_EQ(sightings[1].expected, 2);
  EXPECT_EQ(sightings[1].found, 2);
}

TEST(SightingCounter, CountsWhatWasMatchedBeforeAsExpected) {
  SightingCounter counter;
  counter.Count({}, Found({1}), 2);
  const auto sightings = counter.Take();
  ASSERT_EQ(sightings.size(), 1U);
  EXPECT_EQ(sightings[0].expected, 1);
  EXPECT_EQ(sightings[0].found, 1);
}

TEST(SightingCounter, StartsAnewAfterItWasTakenFrom) {
  SightingCounter counter;
  counter.Count(Expected({1}), {}, 2);
  EXPECT_EQ(counter.Take().size(), 1U);
  EXPECT_TRUE(counter.Take().empty());
  counter.Count(Expected({1}), {}, 4);
  EXPECT_EQ(counter.Take().size(), 1U);
}

}  // namespace
}  // namespace cslam
