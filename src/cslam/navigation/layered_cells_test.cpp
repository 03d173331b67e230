// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/navigation/layered_cells.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

LayeredCells TenCells() {
  return {{.corner_m = {0.0, 0.0, 0.0}, .size = {10, 10, 1}, .cell_m = {0.1, 0.1, 1.0}},
          {.hit = 1.0, .miss = -0.5, .limit = 2.0, .min_readings = 2}};
}

TEST(LayeredCells, MarksCellsOnTheWayFreeAndLeavesOutTheLast) {
  LayeredCells cells = TenCells();
  cells.AddRay({0.05, 0.05, 0.5}, {0.95, 0.55, 0.5});
  cells.Apply();

  EXPECT_LT(cells.At(0, 0, 0), 0.0);
  EXPECT_LT(cells.At(5, 3, 0), 0.0);
  EXPECT_EQ(cells.At(9, 5, 0), 0.0);
  EXPECT_EQ(cells.At(0, 5, 0), 0.0);
}

TEST(LayeredCells, PassesThroughTheSameCellsInBothDirections) {
  LayeredCells there = TenCells();
  LayeredCells back = TenCells();
  const Eigen::Vector3d a(0.07, 0.91, 0.5);
  const Eigen::Vector3d b(0.83, 0.12, 0.5);
  there.AddRay(a, b);
  there.Apply();
  back.AddRay(b, a);
  back.Apply();

  int both = 0;
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 10; ++x)
      both += there.At(x, y, 0) < 0.0 && back.At(x, y, 0) < 0.0 ? 1 : 0;
  }
  EXPECT_GE(both, 13);  // of 16 borders crossed; each leaves out its own end
}

TEST(LayeredCells, LetsAReadingOutweighTheRaysOfItsKeyframe) {
  LayeredCells cells = TenCells();
  cells.AddHit({0.55, 0.05, 0.5});
  cells.AddHit({0.56, 0.05, 0.5});
  cells.AddRay({0.05, 0.05, 0.5}, {0.95, 0.05, 0.5});
  cells.Apply();
  EXPECT_DOUBLE_EQ(cells.At(5, 0, 0), 1.0);
}

TEST(LayeredCells, TakesASingleReadingForStray) {
  LayeredCells cells = TenCells();
  cells.AddHit({0.55, 0.05, 0.5});
  cells.Apply();
  EXPECT_EQ(cells.At(5, 0, 0), 0.0);
}

TEST(LayeredCells, StopsAtTheLimitAndIgnoresWhatIsOutside) {
  LayeredCells cells = TenCells();
  for (int i = 0; i < 10; ++i) {
    cells.AddRay({-0.55, 0.05, 0.5}, {1.95, 0.05, 0.5});
    cells.AddHit({5.0, 5.0, 0.5});
    cells.Apply();
  }
  EXPECT_DOUBLE_EQ(cells.At(5, 0, 0), -2.0);
}

}  // namespace
}  // namespace cslam
