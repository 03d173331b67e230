// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/geometry/alignment.h"

#include "cslam/util/check.h"
#include "cslam/util/random.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace cslam {
namespace {

Se3 SomePose() {
  Vector6 tangent;
  tangent << 0.7, -1.1, 2.0, 3.0, -2.0, 0.5;
  return Exp(tangent);
}

std::vector<Eigen::Vector3d> RandomPoints(int count, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(rng.Uniform(-3.0, 3.0), rng.Uniform(-2.0, 2.0), rng.Uniform(-1.0, 1.0));
  }
  return points;
}

std::vector<Eigen::Vector3d> Moved(const std::vector<Eigen::Vector3d>& points, const Se3& T,
                                   double scale) {
  std::vector<Eigen::Vector3d> moved;
  for (const Eigen::Vector3d& p : points)
    moved.push_back(T * Eigen::Vector3d(scale * p));
  return moved;
}

void ExpectNear(const Se3& expected, const Se3& actual, double tolerance) {
  const PoseDifference difference = Difference(expected, actual);
  EXPECT_LT(difference.angle_rad, tolerance);
  EXPECT_LT(difference.distance_m, tolerance);
}

TEST(AlignPoints, RecoversRigidTransformWhenDataIsExact) {
  const std::vector<Eigen::Vector3d> b = RandomPoints(50, 1);
  const Alignment alignment = AlignPoints(Moved(b, SomePose(), 1.0), b);
  ExpectNear(SomePose(), alignment.T_a_b, 1e-12);
  EXPECT_TRUE(alignment.is_unique);
  EXPECT_EQ(alignment.num_points, 50U);
  EXPECT_EQ(alignment.scale, 1.0);
  EXPECT_LT(alignment.rmse_m, 1e-12);
}

TEST(AlignPoints, RecoversScaleOnlyWhenAsked) {
  const std::vector<Eigen::Vector3d> b = RandomPoints(50, 2);
  const std::vector<Eigen::Vector3d> a = Moved(b, SomePose(), 2.5);
  const Alignment similar = AlignPoints(a, b, AlignmentScale::kEstimated);
  EXPECT_NEAR(similar.scale, 2.5, 1e-12);
  EXPECT_LT(similar.rmse_m, 1e-11);
  const Alignment rigid = AlignPoints(a, b);
  EXPECT_EQ(rigid.scale, 1.0);
  EXPECT_GT(rigid.rmse_m, 1.0);
  EXPECT_LT(Difference(rigid.T_a_b, SomePose()).angle_rad, 1e-12);
}

TEST(AlignPoints, IsTheLeastSquaresOptimumWhenDataIsNoisy) {
  Rng rng(3);
  const std::vector<Eigen::Vector3d> b = RandomPoints(40, 3);
  std::vector<Eigen::Vector3d> a = Moved(b, SomePose(), 1.0);
  for (Eigen::Vector3d& p : a) {
    p += 0.05 * Eigen::Vector3d(rng.Gaussian(), rng.Gaussian(), rng.Gaussian());
  }
  const Alignment best = AlignPoints(a, b);
  EXPECT_NEAR(best.rmse_m, 0.05 * std::sqrt(3.0), 0.015);
  for (int axis = 0; axis < 6; ++axis) {
    for (const double step : {-1e-3, 1e-3}) {
      Alignment other = best;
      other.T_a_b = best.T_a_b * Exp(step * Vector6::Unit(axis));
      double sum = 0.0;
      for (std::size_t i = 0; i < a.size(); ++i)
        sum += (a[i] - other * b[i]).squaredNorm();
      EXPECT_GT(std::sqrt(sum / static_cast<double>(a.size())), best.rmse_m) << "axis " << axis;
    }
  }
}

TEST(AlignPoints, StaysProperWhenDataIsMirrored) {
  const std::vector<Eigen::Vector3d> b = RandomPoints(30, 4);
  std::vector<Eigen::Vector3d> a = b;
  for (Eigen::Vector3d& p : a)
    p.z() = -p.z();
  const Alignment alignment = AlignPoints(a, b, AlignmentScale::kEstimated);
  EXPECT_NEAR(alignment.T_a_b.R().determinant(), 1.0, 1e-12);
  EXPECT_GT(alignment.rmse_m, 0.1);
}

TEST(AlignPoints, IsUniqueWhenPointsLieInAPlane) {
  std::vector<Eigen::Vector3d> b = RandomPoints(30, 5);
  for (Eigen::Vector3d& p : b)
    p.z() = 0.0;
  const Alignment alignment = AlignPoints(Moved(b, SomePose(), 1.0), b);
  EXPECT_TRUE(alignment.is_unique);
  ExpectNear(SomePose(), alignment.T_a_b, 1e-12);
}

TEST(AlignPoints, FitsButIsNotUniqueWhenPointsLieOnALine) {
  std::vector<Eigen::Vector3d> b;
  for (int i = 0; i < 10; ++i)
    b.push_back(0.1 * i * Eigen::Vector3d(1.0, 2.0, 3.0));
  const Alignment alignment = AlignPoints(Moved(b, SomePose(), 1.0), b);
  EXPECT_FALSE(alignment.is_unique);
  EXPECT_LT(alignment.rmse_m, 1e-9);
}

TEST(AlignPoints, ReturnsTranslationWhenAllPointsCoincide) {
  const Eigen::Vector3d shift(1.0, 2.0, 3.0);
  const std::vector<Eigen::Vector3d> b(5, Eigen::Vector3d(0.3, 0.1, 0.7));
  const std::vector<Eigen::Vector3d> a(5, b.front() + shift);
  const Alignment alignment = AlignPoints(a, b, AlignmentScale::kEstimated);
  EXPECT_FALSE(alignment.is_unique);
  EXPECT_EQ(alignment.scale, 1.0);
  ExpectNear(Se3(Eigen::Quaterniond::Identity(), shift), alignment.T_a_b, 1e-12);
}

TEST(AlignPoints, ReturnsIdentityWhenThereAreNoPoints) {
  const Alignment alignment = AlignPoints({}, {});
  EXPECT_FALSE(alignment.is_unique);
  EXPECT_EQ(alignment.num_points, 0U);
  EXPECT_EQ(alignment.rmse_m, 0.0);
  ExpectNear(Se3(), alignment.T_a_b, 1e-15);
}

TEST(AlignPoints, LeavesOutPairsWhenACoordinateIsNotFinite) {
  std::vector<Eigen::Vector3d> b = RandomPoints(20, 6);
  const std::vector<Eigen::Vector3d> a = Moved(b, SomePose(), 1.0);
  b[7].y() = std::numeric_limits<double>::quiet_NaN();
  const Alignment alignment = AlignPoints(a, b);
  EXPECT_EQ(alignment.num_points, 19U);
  ExpectNear(SomePose(), alignment.T_a_b, 1e-12);
}

TEST(AlignPoints, ThrowsWhenSpansDifferInLength) {
  EXPECT_THROW(AlignPoints(RandomPoints(3, 7), RandomPoints(4, 7)), InternalError);
}

}  // namespace
}  // namespace cslam
