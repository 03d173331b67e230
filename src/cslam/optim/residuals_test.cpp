// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/optim/residuals.h"

#include "cslam/optim/test_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace cslam {
namespace {

using test::kBaseline;
using test::TestCamera;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(PixelDisparityModel, JacobianEqualsCentralDifferences) {
  const PixelDisparityModel model(TestCamera(), kBaseline);
  Rng rng(1);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Vector3d p = test::RandomVisiblePoint(TestCamera(), rng);
    const Eigen::Matrix3d jacobian = model.Jacobian(p);
    for (int axis = 0; axis < 3; ++axis) {
      constexpr double kStep = 1e-6;
      const Eigen::Vector3d offset = kStep * Eigen::Vector3d::Unit(axis);
      const Eigen::Vector3d numeric =
          (model.Predict(p + offset) - model.Predict(p - offset)) / (2.0 * kStep);
      EXPECT_LT((jacobian.col(axis) - numeric).norm(), 1e-4) << "axis " << axis;
    }
  }
}

TEST(PixelDisparityModel, PredictsThePinholePixelAndTheDisparity) {
  const Camera camera = TestCamera();
  const Eigen::Vector3d p(0.4, -0.2, 2.0);
  const Eigen::Vector3d uvd = PixelDisparityModel(camera, kBaseline).Predict(p);
  EXPECT_LT((uvd.head<2>() - Project(camera, p)).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(uvd.z(), camera.fx * kBaseline / 2.0);
}

TEST(MakeMeasurement, HasNoDisparityWhenThereIsNoDepthReading) {
  const Measurement m = MakeMeasurement({10.0, 20.0}, -1.0, 4.0, 9.0);
  EXPECT_TRUE(m.is_usable);
  EXPECT_FALSE(m.has_disparity);
  EXPECT_EQ(m.sqrt_information, Eigen::Vector3d(2.0, 2.0, 0.0));
  EXPECT_FALSE(MakeMeasurement({10.0, 20.0}, kNan, 4.0, 9.0).has_disparity);
  EXPECT_FALSE(MakeMeasurement({10.0, 20.0}, 5.0, 4.0, 0.0).has_disparity);
  EXPECT_TRUE(MakeMeasurement({10.0, 20.0}, 5.0, 4.0, 9.0).has_disparity);
}

TEST(MakeMeasurement, IsUnusableWhenPixelOrInformationIsBad) {
  EXPECT_FALSE(MakeMeasurement({kNan, 20.0}, 5.0, 4.0, 9.0).is_usable);
  EXPECT_FALSE(MakeMeasurement({10.0, kInfinity}, 5.0, 4.0, 9.0).is_usable);
  EXPECT_FALSE(MakeMeasurement({10.0, 20.0}, 5.0, 0.0, 9.0).is_usable);
  EXPECT_FALSE(MakeMeasurement({10.0, 20.0}, 5.0, kNan, 9.0).is_usable);
}

TEST(Chi2, CountsSquaredSigmas) {
  const PixelDisparityModel model(TestCamera(), kBaseline);
  const Eigen::Vector3d p(0.1, 0.2, 1.5);
  const Eigen::Vector3d uvd = model.Predict(p);
  const Eigen::Vector2d uv_px = uvd.head<2>() + Eigen::Vector2d(3.0, -1.0);
  EXPECT_NEAR(Chi2(model, MakeMeasurement(uv_px, uvd.z() + 2.0, 0.5, 0.25), p), 6.0, 1e-9);
  EXPECT_NEAR(Chi2(model, MakeMeasurement(uv_px, -1.0, 0.5, 0.25), p), 5.0, 1e-9);
}

TEST(Chi2, IsInfiniteWhenThePointIsBehindOrNotFinite) {
  const PixelDisparityModel model(TestCamera(), kBaseline);
  const Measurement m = MakeMeasurement({10.0, 20.0}, 5.0, 1.0, 1.0);
  EXPECT_EQ(Chi2(model, m, {0.1, 0.1, -1.0}), kInfinity);
  EXPECT_EQ(Chi2(model, m, {0.1, 0.1, 0.0}), kInfinity);
  EXPECT_EQ(Chi2(model, m, {0.1, 0.1, kNan}), kInfinity);
  EXPECT_EQ(Chi2(model, m, {kNan, 0.1, 1.0}), kInfinity);
  EXPECT_EQ(Chi2(model, Measurement{}, {0.1, 0.1, 1.0}), kInfinity);
}

TEST(HuberCost, IsSmoothAtTheThreshold) {
  EXPECT_EQ(HuberCost(3.0, 4.0), 3.0);
  EXPECT_EQ(HuberCost(4.0, 4.0), 4.0);
  EXPECT_NEAR((HuberCost(4.0 + 1e-6, 4.0) - 4.0) / 1e-6, 1.0, 1e-5);
  EXPECT_DOUBLE_EQ(HuberCost(16.0, 4.0), 12.0);
}

}  // namespace
}  // namespace cslam
