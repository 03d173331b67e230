// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/optim/ba_residual.h"

#include "cslam/optim/test_scene.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

using test::kBaseline;
using test::TestCamera;

struct Case {
  PixelDisparityModel model{TestCamera(), kBaseline};
  Measurement measurement;
  Se3 T_camera_world_start;
  Vector6 move;
  Eigen::Vector3d p_world;

  Eigen::Vector3d Error(const Vector6& at_move, const Eigen::Vector3d& p) const {
    return BaError(model, measurement, MovedPose(T_camera_world_start, at_move) * p);
  }
};

Case RandomCase(double move_rad, bool has_depth, Rng& rng) {
  Case c;
  c.T_camera_world_start = test::RandomMotion(rng, 1.0, 2.0);
  c.move << move_rad * test::GaussianVector(rng), 0.3 * test::GaussianVector(rng);
  const Eigen::Vector3d p_camera = test::RandomVisiblePoint(TestCamera(), rng);
  c.p_world = MovedPose(c.T_camera_world_start, c.move).Inverse() * p_camera;
  c.measurement =
      MeasurementOf(test::Observe<BaObservation>(TestCamera(), p_camera, has_depth, 1.0, rng));
  return c;
}

struct Jacobians {
  Eigen::Matrix3d by_point, by_rotation, by_translation;
};

Jacobians Analytic(const Case& c) {
  const PoseChart pose = MakePoseChart(c.T_camera_world_start, c.move);
  const Eigen::Vector3d p_camera = pose.R_camera_world * c.p_world + pose.t_camera_world;
  Jacobians j;
  j.by_translation = BaErrorByTranslation(c.model, c.measurement, p_camera);
  j.by_rotation = BaErrorByRotation(j.by_translation, pose, p_camera);
  j.by_point = j.by_translation * pose.R_camera_world;
  return j;
}

Jacobians Numeric(const Case& c) {
  constexpr double kStep = 1e-6;
  Jacobians j;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d offset = kStep * Eigen::Vector3d::Unit(axis);
    j.by_point.col(axis) =
        (c.Error(c.move, c.p_world + offset) - c.Error(c.move, c.p_world - offset)) / (2 * kStep);
    const Vector6 turn = kStep * Vector6::Unit(axis);
    const Vector6 shift = kStep * Vector6::Unit(3 + axis);
    j.by_rotation.col(axis) =
        (c.Error(c.move + turn, c.p_world) - c.Error(c.move - turn, c.p_world)) / (2 * kStep);
    j.by_translation.col(axis) =
        (c.Error(c.move + shift, c.p_world) - c.Error(c.move - shift, c.p_world)) / (2 * kStep);
  }
  return j;
}

void ExpectClose(const Eigen::Matrix3d& analytic, const Eigen::Matrix3d& numeric) {
  EXPECT_LT((analytic - numeric).norm(), 1e-6 * (1.0 + numeric.norm())) << analytic << "\nagainst\n"
                                                                        << numeric;
}

TEST(BaJacobians, EqualCentralDifferencesForSmallAndLargeMoves) {
  Rng rng(1);
  for (const double move_rad : {0.0, 1e-6, 1e-3, 0.1, 1.0}) {
    for (int trial = 0; trial < 20; ++trial) {
      const Case c = RandomCase(move_rad, trial % 2 == 0, rng);
      const Jacobians analytic = Analytic(c);
      const Jacobians numeric = Numeric(c);
      ExpectClose(analytic.by_point, numeric.by_point);
      ExpectClose(analytic.by_rotation, numeric.by_rotation);
      ExpectClose(analytic.by_translation, numeric.by_translation);
    }
  }
}

TEST(BaError, HasNoDisparityRowWhenThereIsNoDepth) {
  Rng rng(2);
  const Case c = RandomCase(0.1, false, rng);
  EXPECT_EQ(c.Error(c.move, c.p_world).z(), 0.0);
  EXPECT_TRUE(Analytic(c).by_point.row(2).isZero(0.0));
}

TEST(BaError, IsConstantWhenThePointIsBehindTheCamera) {
  Rng rng(3);
  const Case c = RandomCase(0.1, true, rng);
  const Eigen::Vector3d p_camera(0.1, 0.2, -1.0);
  EXPECT_EQ(BaError(c.model, c.measurement, p_camera), Eigen::Vector3d(kBehindError, 0.0, 0.0));
  EXPECT_TRUE(BaErrorByTranslation(c.model, c.measurement, p_camera).isZero(0.0));
}

TEST(MakePoseChart, IsTheStartWhenNothingMoved) {
  Rng rng(4);
  const Se3 start = test::RandomMotion(rng, 1.0, 2.0);
  const PoseChart chart = MakePoseChart(start, Vector6::Zero());
  EXPECT_LT((chart.R_camera_world - start.R()).norm(), 1e-15);
  EXPECT_LT((chart.t_camera_world - start.translation).norm(), 1e-15);
  EXPECT_EQ(chart.left_jacobian, Eigen::Matrix3d::Identity());
}

}  // namespace
}  // namespace cslam
