// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/object_filter.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <functional>

namespace cslam {
namespace {

constexpr double kFrameS = 1.0 / 30.0;

// Filters an object seen from a camera at rest, its place given by time.
ObjectFilter Watch(
    int frames, const std::function<Eigen::Vector3d(double)>& p_camera,
    const std::function<bool(int)>& is_clipped = [](int) { return false; }) {
  const ObjectFilterOptions options;
  ObjectFilter filter(Se3(), {.centre_camera = p_camera(0.0)});
  for (int i = 1; i < frames; ++i) {
    filter.Predict(kFrameS, options);
    filter.Update(Se3(), {.centre_camera = p_camera(i * kFrameS), .is_clipped = is_clipped(i)},
                  kFrameS, options);
  }
  return filter;
}

TEST(ObjectFilter, KnowsNothingAtFirst) {
  const ObjectFilter filter(Se3(), {.centre_camera = {0.0, 0.0, 2.0}});
  EXPECT_EQ(filter.motion(), ObjectMotion::kUnknown);
  EXPECT_TRUE(filter.covariance().isIdentity());
}

TEST(ObjectFilter, CallsAChairAtRestStaticWithinASecond) {
  const ObjectFilter filter = Watch(30, [](double t) {
    return Eigen::Vector3d(0.005 * std::sin(40.0 * t), 0.0, 2.0 + 0.01 * std::cos(33.0 * t));
  });
  EXPECT_EQ(filter.motion(), ObjectMotion::kStatic);
}

TEST(ObjectFilter, CallsAWalkerMovingWithinHalfASecondAndKnowsTheSpeed) {
  const ObjectFilter filter =
      Watch(15, [](double t) { return Eigen::Vector3d(1.0 * t, 0.0, 2.5); });
  EXPECT_EQ(filter.motion(), ObjectMotion::kMoving);
  EXPECT_NEAR(filter.velocity().x(), 1.0, 0.15);
}

TEST(ObjectFilter, CallsAThingStaticAgainOnceItRests) {
  const auto stops = [](double t) { return Eigen::Vector3d(std::min(t, 1.0), 0.0, 2.0); };
  EXPECT_EQ(Watch(28, stops).motion(), ObjectMotion::kMoving);
  EXPECT_EQ(Watch(75, stops).motion(), ObjectMotion::kStatic);
}

TEST(ObjectFilter, DoesNotCallAChairMovingThatLeavesThePicture) {
  // The visible part's centre slides towards the border as the chair is cut off.
  const ObjectFilter filter = Watch(
      60, [](double t) { return Eigen::Vector3d(t < 1.0 ? 0.0 : 0.3 * (t - 1.0), 0.0, 2.0); },
      [](int i) { return i >= 30; });
  EXPECT_EQ(filter.motion(), ObjectMotion::kStatic);
}

TEST(ObjectFilter, KeepsItsCovarianceSymmetricAndPositive) {
  const ObjectFilter filter =
      Watch(300, [](double t) { return Eigen::Vector3d(std::sin(t), 0.1 * t, 2.0 + 0.2 * t); });
  const Matrix6& P = filter.covariance();
  EXPECT_TRUE(P.isApprox(P.transpose(), 1e-9));
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6>(P).eigenvalues().minCoeff(), 0.0);
}

TEST(ObjectFilter, SeesAStandingObjectAtRestFromAMovingCamera) {
  const ObjectFilterOptions options;
  const Eigen::Vector3d p_world(0.5, 0.2, 3.0);
  std::optional<ObjectFilter> filter;
  for (int i = 0; i < 40; ++i) {
    const Se3 T_world_camera{
        Eigen::Quaterniond(Eigen::AngleAxisd(0.01 * i, Eigen::Vector3d::UnitY())),
        {0.02 * i, 0.0, 0.0}};
    const CentreMeasurement seen{.centre_camera = T_world_camera.Inverse() * p_world};
    if (!filter) {
      filter.emplace(T_world_camera, seen);
      continue;
    }
    filter->Predict(kFrameS, options);
    filter->Update(T_world_camera, seen, kFrameS, options);
  }
  EXPECT_EQ(filter->motion(), ObjectMotion::kStatic);
  EXPECT_LT((filter->position() - p_world).norm(), 1e-3);
}

TEST(ObjectFilter, MovesAlongWhenTheWorldIsCorrected) {
  ObjectFilter filter = Watch(30, [](double t) { return Eigen::Vector3d(t, 0.0, 2.0); });
  const Eigen::Vector3d before = filter.position();
  const Eigen::Vector3d speed = filter.velocity();
  const Se3 T_new_old{Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ())),
                      {1.0, 2.0, 3.0}};
  filter.MoveWorld(T_new_old);
  EXPECT_LT((filter.position() - T_new_old * before).norm(), 1e-12);
  EXPECT_LT((filter.velocity() - T_new_old.R() * speed).norm(), 1e-12);
}

}  // namespace
}  // namespace cslam
