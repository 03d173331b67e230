// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/navigation/floor.h"

#include "cslam/util/random.h"

#include <gtest/gtest.h>

#include <vector>

namespace cslam {
namespace {

// A horizontal or upright patch of surface elements in a world with y down, then tilted.
struct Patch {
  Eigen::Vector3d centre;
  Eigen::Vector3d normal;
  double side_m = 1.0;
  int count = 400;
};

std::vector<SurfaceElement> Scatter(const std::vector<Patch>& patches, double tilt_rad,
                                    double noise_m) {
  Rng rng(1);
  const Eigen::Quaterniond tilt = ExpSo3({tilt_rad, 0.0, 0.0});
  std::vector<SurfaceElement> elements;
  for (const Patch& patch : patches) {
    for (int i = 0; i < patch.count; ++i) {
      Eigen::Vector3d offset;
      for (int axis = 0; axis < 3; ++axis)
        offset[axis] = rng.Uniform(-0.5, 0.5) * patch.side_m;
      offset -= offset.dot(patch.normal) * patch.normal;
      const Eigen::Vector3d p = patch.centre + offset + noise_m * rng.Gaussian() * patch.normal;
      elements.push_back({tilt * p, tilt * patch.normal,
                          patch.side_m * patch.side_m / static_cast<double>(patch.count)});
    }
  }
  return elements;
}

const Eigen::Vector3d kUp = -Eigen::Vector3d::UnitY();

TEST(EstimateFloor, FindsTheLowestLargeSurfaceOfATiltedWorld) {
  const double tilt_rad = 0.4;
  const auto elements = Scatter({{{0.0, 1.2, 2.0}, kUp, 1.0},
                                 {{0.0, 0.5, 2.0}, kUp, 1.6},
                                 {{0.0, 0.0, 4.0}, -Eigen::Vector3d::UnitZ(), 3.0}},
                                tilt_rad, 0.01);

  const Floor floor = EstimateFloor(elements, kUp, {});

  const Eigen::Quaterniond tilt = ExpSo3({tilt_rad, 0.0, 0.0});
  EXPECT_TRUE(floor.is_seen);
  EXPECT_GT(floor.up_world.dot(tilt * kUp), 0.9995);
  EXPECT_NEAR(floor.HeightM(tilt * Eigen::Vector3d(0.0, 1.2, 2.0)), 0.0, 0.01);
  EXPECT_NEAR(floor.HeightM(tilt * Eigen::Vector3d(0.0, 0.5, 2.0)), 0.7, 0.02);
}

TEST(EstimateFloor, IsNotMisledByFewReadingsBelowTheFloor) {
  const auto elements =
      Scatter({{{0.0, 1.2, 2.0}, kUp, 2.0}, {{0.0, 2.0, 3.0}, kUp, 0.3, 60}}, 0.0, 0.005);
  EXPECT_NEAR(EstimateFloor(elements, kUp, {}).HeightM({0.0, 1.2, 2.0}), 0.0, 0.01);
}

TEST(EstimateFloor, TakesTheLowestReadingForItWhereNothingIsLevel) {
  const auto elements = Scatter({{{0.0, 0.0, 4.0}, -Eigen::Vector3d::UnitZ(), 2.0}}, 0.0, 0.005);
  const Floor floor = EstimateFloor(elements, kUp, {});
  EXPECT_FALSE(floor.is_seen);
  EXPECT_NEAR(floor.HeightM({0.0, 1.0, 4.0}), 0.0, 0.1);
}

TEST(EstimateFloor, SaysSoWithoutAnyReadings) {
  EXPECT_FALSE(EstimateFloor(std::vector<SurfaceElement>{}, kUp, {}).is_seen);
}

}  // namespace
}  // namespace cslam
