// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/geometry/se3.h"

#include "cslam/util/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace cslam {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kTrials = 200;

Eigen::Vector3d RandomVector(Rng& rng, double size) {
  const double x = rng.Uniform(-size, size);
  const double y = rng.Uniform(-size, size);
  const double z = rng.Uniform(-size, size);
  return {x, y, z};
}

Vector6 RandomTangent(Rng& rng, double angle_rad, double size_m) {
  Vector6 tangent;
  tangent << angle_rad * RandomVector(rng, 1.0).normalized(), RandomVector(rng, size_m);
  return tangent;
}

Se3 RandomPose(Rng& rng) {
  return Exp(RandomTangent(rng, rng.Uniform(0.0, kPi), 5.0));
}

void ExpectNear(const Se3& expected, const Se3& actual, double tolerance) {
  EXPECT_LT((expected.Matrix() - actual.Matrix()).norm(), tolerance)
      << expected.Matrix() << "\nagainst\n"
      << actual.Matrix();
}

TEST(Se3, CompositionIsAssociative) {
  Rng rng(1);
  for (int i = 0; i < kTrials; ++i) {
    const Se3 a = RandomPose(rng);
    const Se3 b = RandomPose(rng);
    const Se3 c = RandomPose(rng);
    ExpectNear((a * b) * c, a * (b * c), 1e-12);
  }
}

TEST(Se3, InverseUndoesFromBothSides) {
  Rng rng(2);
  for (int i = 0; i < kTrials; ++i) {
    const Se3 T = RandomPose(rng);
    ExpectNear(T * T.Inverse(), Se3(), 1e-12);
    ExpectNear(T.Inverse() * T, Se3(), 1e-12);
    ExpectNear(T * Se3(), T, 1e-14);
    ExpectNear(Se3() * T, T, 1e-14);
  }
}

TEST(Se3, ActsOnPointsAsItsMatrixDoes) {
  Rng rng(3);
  for (int i = 0; i < kTrials; ++i) {
    const Se3 a = RandomPose(rng);
    const Se3 b = RandomPose(rng);
    const Eigen::Vector3d p = RandomVector(rng, 10.0);
    const Eigen::Vector4d by_matrix = a.Matrix() * b.Matrix() * p.homogeneous();
    EXPECT_LT(((a * b) * p - by_matrix.head<3>()).norm(), 1e-12);
    EXPECT_LT(((a * b) * p - a * (b * p)).norm(), 1e-12);
  }
}

TEST(Se3, StaysUnitAfterManyCompositions) {
  Rng rng(4);
  Se3 T;
  const Se3 step = RandomPose(rng);
  for (int i = 0; i < 10'000; ++i)
    T = T * step;
  EXPECT_NEAR(T.rotation.norm(), 1.0, 1e-14);
}

TEST(Se3, NormalisesTheQuaternionItIsMadeFrom) {
  const Se3 T(Eigen::Quaterniond(2.0, 0.0, 0.0, 2.0), Eigen::Vector3d::Zero());
  EXPECT_NEAR(T.rotation.norm(), 1.0, 1e-15);
  EXPECT_NEAR(AngleOf(T), kPi / 2.0, 1e-14);
}

TEST(Se3, IsNotFiniteWhenAnyNumberIsNot) {
  Se3 T;
  EXPECT_TRUE(T.IsFinite());
  T.translation.z() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(T.IsFinite());
  T = Se3();
  T.rotation.w() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(T.IsFinite());
}

// Log undoes Exp at every angle, also where series take over and where the axis may flip.
class ExpLog : public testing::TestWithParam<double> {};

TEST_P(ExpLog, LogUndoesExp) {
  Rng rng(5);
  for (int i = 0; i < kTrials; ++i) {
    const Vector6 tangent = RandomTangent(rng, GetParam(), 3.0);
    EXPECT_LT((Log(Exp(tangent)) - tangent).norm(), 1e-9) << tangent.transpose();
  }
}

TEST_P(ExpLog, ExpUndoesLog) {
  Rng rng(6);
  for (int i = 0; i < kTrials; ++i) {
    const Se3 T(ExpSo3(GetParam() * RandomVector(rng, 1.0).normalized()), RandomVector(rng, 3.0));
    ExpectNear(T, Exp(Log(T)), 1e-9);
    EXPECT_NEAR(AngleOf(T), GetParam(), 1e-9);
  }
}

TEST_P(ExpLog, ExpIsTheMatrixExponential) {
  Rng rng(7);
  for (int i = 0; i < 20; ++i) {
    const Vector6 tangent = RandomTangent(rng, GetParam(), 1.0);
    Eigen::Matrix4d hat = Eigen::Matrix4d::Zero();
    hat.topLeftCorner<3, 3>() = Skew(tangent.head<3>());
    hat.topRightCorner<3, 1>() = tangent.tail<3>();
    Eigen::Matrix4d sum = Eigen::Matrix4d::Identity();
    Eigen::Matrix4d term = Eigen::Matrix4d::Identity();
    for (int n = 1; n < 40; ++n) {
      term = term * hat / n;
      sum += term;
    }
    EXPECT_LT((Exp(tangent).Matrix() - sum).norm(), 1e-10);
  }
}

INSTANTIATE_TEST_SUITE_P(Angles, ExpLog,
                         testing::Values(0.0, 1e-12, 1e-8, 0.99e-5, 1.01e-5, 1e-4, 0.1, 1.0, 3.0,
                                         kPi - 1e-3, kPi - 1e-6, kPi - 1e-9));

TEST(LogSo3, GivesTheShortWayWhenTheQuaternionIsNegated) {
  Rng rng(8);
  for (int i = 0; i < kTrials; ++i) {
    const Eigen::Vector3d w = rng.Uniform(0.0, kPi - 1e-6) * RandomVector(rng, 1.0).normalized();
    Eigen::Quaterniond negated = ExpSo3(w);
    negated.coeffs() = -negated.coeffs();
    EXPECT_LT((LogSo3(negated) - w).norm(), 1e-9);
  }
}

TEST(LogSo3, HasLengthPiWhenTurnedHalfWay) {
  EXPECT_NEAR(LogSo3(Eigen::Quaterniond(0.0, 0.6, 0.0, 0.8)).norm(), kPi, 1e-12);
}

TEST(Adjoint, CarriesTangentsAcross) {
  Rng rng(9);
  for (int i = 0; i < kTrials; ++i) {
    const Se3 T = RandomPose(rng);
    const Vector6 x = RandomTangent(rng, rng.Uniform(0.0, 3.0), 1.0);
    ExpectNear(T * Exp(x), Exp(Adjoint(T) * x) * T, 1e-10);
  }
}

TEST(Adjoint, IsAHomomorphism) {
  Rng rng(10);
  for (int i = 0; i < kTrials; ++i) {
    const Se3 a = RandomPose(rng);
    const Se3 b = RandomPose(rng);
    EXPECT_LT((Adjoint(a * b) - Adjoint(a) * Adjoint(b)).norm(), 1e-11);
    EXPECT_LT((Adjoint(a.Inverse()) * Adjoint(a) - Matrix6::Identity()).norm(), 1e-11);
  }
}

TEST(Skew, IsTheCrossProduct) {
  Rng rng(11);
  const Eigen::Vector3d a = RandomVector(rng, 2.0);
  const Eigen::Vector3d b = RandomVector(rng, 2.0);
  EXPECT_LT((Skew(a) * b - a.cross(b)).norm(), 1e-15);
}

TEST(Difference, IsZeroForEqualPosesAndSymmetric) {
  Rng rng(12);
  for (int i = 0; i < kTrials; ++i) {
    const Se3 a = RandomPose(rng);
    const Se3 b = RandomPose(rng);
    EXPECT_LT(Difference(a, a).angle_rad, 1e-7);
    EXPECT_LT(Difference(a, a).distance_m, 1e-12);
    EXPECT_NEAR(Difference(a, b).angle_rad, Difference(b, a).angle_rad, 1e-12);
    EXPECT_NEAR(Difference(a, b).distance_m, (a.translation - b.translation).norm(), 1e-12);
  }
}

TEST(Interpolate, MeetsItsEndsAndTheMiddle) {
  Rng rng(13);
  for (int i = 0; i < kTrials; ++i) {
    const Se3 a = RandomPose(rng);
    const Se3 b = a * Exp(RandomTangent(rng, rng.Uniform(0.0, 3.0), 1.0));
    ExpectNear(Interpolate(a, b, 0.0), a, 1e-12);
    ExpectNear(Interpolate(a, b, 1.0), b, 1e-12);
    const Se3 middle = Interpolate(a, b, 0.5);
    EXPECT_NEAR(Difference(a, middle).angle_rad, 0.5 * Difference(a, b).angle_rad, 1e-7);
    EXPECT_LT((middle.translation - 0.5 * (a.translation + b.translation)).norm(), 1e-12);
  }
}

TEST(Interpolate, TurnsTheShortWayWhenAQuaternionIsNegated) {
  const Se3 a(ExpSo3({0.0, 0.0, 0.2}), Eigen::Vector3d::Zero());
  Se3 b(ExpSo3({0.0, 0.0, 0.4}), Eigen::Vector3d::Zero());
  b.rotation.coeffs() = -b.rotation.coeffs();
  EXPECT_NEAR(LogSo3(Interpolate(a, b, 0.5).rotation).z(), 0.3, 1e-12);
}

}  // namespace
}  // namespace cslam
