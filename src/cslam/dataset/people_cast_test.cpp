// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/people_cast.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cslam {
namespace {

const std::vector<FloorPoint> kCycle{{0.0, {0.0, 0.0}}, {4.0, {1.0, 0.0}, 0.5}, {10.0, {0.0, 0.0}}};

TEST(CutCycle, StartsBeforeTheWindowAndCoversIt) {
  for (const double from_s : {0.0, 3.0, 4.0, 9.5, 27.0}) {
    const std::vector<FloorPoint> points = CutCycle(kCycle, from_s, from_s + 15.0);
    EXPECT_LE(points.front().time_s, 0.0);
    EXPECT_GT(points[1].time_s, 0.0);
    EXPECT_GE(points.back().time_s, 15.0);
    for (const FloorPoint& point : points) {
      const double phase_s = std::fmod(point.time_s + from_s + 100.0, 10.0);
      EXPECT_DOUBLE_EQ(point.position_m.x(), std::abs(phase_s - 4.0) < 1e-9 ? 1.0 : 0.0);
    }
  }
}

TEST(Mirrored, MirrorsPlacesAndDirections) {
  const std::vector<FloorPoint> points = Mirrored(kCycle, 3.0);
  EXPECT_DOUBLE_EQ(points[1].position_m.x(), 5.0);
  EXPECT_DOUBLE_EQ(*points[1].facing_rad, std::numbers::pi - 0.5);
  EXPECT_FALSE(points[0].facing_rad.has_value());
}

}  // namespace
}  // namespace cslam
