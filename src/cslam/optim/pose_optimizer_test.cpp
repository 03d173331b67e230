// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/optim/pose_optimizer.h"

#include "cslam/optim/test_scene.h"
#include "cslam/util/options.h"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace cslam {
namespace {

using test::kBaseline;
using test::MakePoseScene;
using test::PoseScene;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

PoseSolution Solve(const PoseScene& scene, const Se3& start,
                   const PoseOptimizerOptions& options = {}) {
  return OptimizePose(scene.camera, kBaseline, start, scene.observations, options);
}

constexpr PoseOptimizerOptions kLeastSquares{.kernel_chi2 = 1000.0};  // so wide that it is none

Se3 NearbyPose(const Se3& T, std::uint64_t seed) {
  Rng rng(seed);
  return T * test::RandomMotion(rng, 0.02, 0.04);
}

// Errors of all observations in sigmas, three rows each.
Eigen::VectorXd Errors(const PoseScene& scene, const Se3& T_world_camera) {
  const PixelDisparityModel model(scene.camera, kBaseline);
  const Se3 T_camera_world = T_world_camera.Inverse();
  Eigen::VectorXd errors(3 * static_cast<Eigen::Index>(scene.observations.size()));
  for (std::size_t i = 0; i < scene.observations.size(); ++i) {
    const Measurement m = MeasurementOf(scene.observations[i]);
    const Eigen::Vector3d predicted = model.Predict(T_camera_world * scene.observations[i].p_world);
    errors.segment<3>(3 * static_cast<Eigen::Index>(i)) =
        (predicted - m.value).cwiseProduct(m.sqrt_information);
  }
  return errors;
}

Eigen::Matrix<double, Eigen::Dynamic, 6> NumericJacobian(const PoseScene& scene, const Se3& T) {
  constexpr double kStep = 1e-6;
  Eigen::Matrix<double, Eigen::Dynamic, 6> jacobian(3 * scene.observations.size(), 6);
  for (int axis = 0; axis < 6; ++axis) {
    const Vector6 offset = kStep * Vector6::Unit(axis);
    jacobian.col(axis) =
        (Errors(scene, T * Exp(offset)) - Errors(scene, T * Exp(-offset))) / (2.0 * kStep);
  }
  return jacobian;
}

TEST(OptimizePose, RecoversThePoseWhenDataIsExact) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const PoseScene scene = MakePoseScene(100, 0.0, seed);
    const PoseSolution solution = Solve(scene, NearbyPose(scene.T_world_camera, seed));
    const PoseDifference error = Difference(solution.T_world_camera, scene.T_world_camera);
    EXPECT_LT(error.angle_rad, 1e-6) << "seed " << seed;
    EXPECT_LT(error.distance_m, 1e-6) << "seed " << seed;
    EXPECT_EQ(solution.num_inliers, 100);
    EXPECT_LT(solution.mean_chi2, 1e-6);
  }
}

// As many points that have moved together as points that have not: weight decides.
TEST(OptimizePose, FollowsTheHeavierPointsWhenHalfHaveMoved) {
  PoseScene scene = MakePoseScene(200, 0.0, 3);
  for (std::size_t i = 0; i < scene.observations.size(); i += 2) {
    scene.observations[i].uv_px.x() += 3.0;
    scene.observations[i].weight = 0.125;
  }
  const PoseSolution trusting = Solve(scene, scene.T_world_camera);
  EXPECT_LT(Difference(trusting.T_world_camera, scene.T_world_camera).angle_rad, 5e-4);
  for (std::size_t i = 0; i < scene.observations.size(); ++i)
    scene.observations[i].weight = i % 2 == 0 ? 1.0 : 0.125;
  const PoseSolution misled = Solve(scene, scene.T_world_camera);
  EXPECT_GT(Difference(misled.T_world_camera, scene.T_world_camera).angle_rad, 2e-3);
}

TEST(OptimizePose, LeavesOutWhatHasNoWeight) {
  PoseScene scene = MakePoseScene(50, 0.0, 3);
  scene.observations[0].weight = 0.0;
  scene.observations[1].weight = kNan;
  const PoseSolution solution = Solve(scene, scene.T_world_camera);
  EXPECT_EQ(solution.num_inliers, 48);
  EXPECT_EQ(solution.is_inlier[1], 0);
}

// The information is J^T J, so this checks every entry of the analytic Jacobian.
TEST(OptimizePose, ReturnsTheInformationOfTheNumericJacobian) {
  const PoseScene scene = MakePoseScene(57, 0.0, 1);  // some lanes of the last block are empty
  const PoseSolution solution = Solve(scene, scene.T_world_camera);
  ASSERT_EQ(solution.num_inliers, 57);
  const auto jacobian = NumericJacobian(scene, solution.T_world_camera);
  const Matrix6 numeric = jacobian.transpose() * jacobian;
  EXPECT_LT((solution.information - numeric).norm(), 1e-6 * numeric.norm());
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      const double scale = std::sqrt(numeric(row, row) * numeric(column, column));
      EXPECT_NEAR(solution.information(row, column), numeric(row, column), 1e-6 * scale)
          << row << " " << column;
    }
  }
}

TEST(OptimizePose, EndsWhereTheGradientVanishesWhenDataIsNoisy) {
  PoseScene scene = MakePoseScene(200, 1.0, 2);
  const PoseSolution solution = Solve(scene, NearbyPose(scene.T_world_camera, 2), kLeastSquares);
  PoseScene inliers = scene;
  inliers.observations.clear();
  for (std::size_t i = 0; i < scene.observations.size(); ++i) {
    if (solution.is_inlier[i]) inliers.observations.push_back(scene.observations[i]);
  }
  const auto jacobian = NumericJacobian(inliers, solution.T_world_camera);
  const Vector6 gradient = jacobian.transpose() * Errors(inliers, solution.T_world_camera);
  const Vector6 step = solution.information.llt().solve(gradient);
  // In sigmas of the pose.
  EXPECT_LT(std::sqrt(gradient.dot(step)), 0.05);
}

TEST(OptimizePose, ErrsAsItsInformationSaysWhenDataIsNoisy) {
  double sum = 0.0;
  constexpr int kTrials = 100;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto seed = static_cast<std::uint64_t>(trial);
    const PoseScene scene = MakePoseScene(100, 1.0, seed);
    const PoseSolution solution =
        Solve(scene, NearbyPose(scene.T_world_camera, seed), kLeastSquares);
    const Vector6 error = Log(solution.T_world_camera.Inverse() * scene.T_world_camera);
    sum += error.dot(solution.information * error);
  }
  EXPECT_NEAR(sum / kTrials, 6.0, 1.5);  // chi2 with 6 dof, a little more as inliers are cut off
}

TEST(OptimizePose, IsLessDisturbedByWrongMatchesInsideTheGateThanLeastSquares) {
  double with_kernel = 0.0;
  double without = 0.0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    PoseScene scene = MakePoseScene(200, 0.3, seed);
    // One in five is off by two or so pixels to one side: too little for the gate to notice.
    for (std::size_t i = 0; i < scene.observations.size(); i += 5) {
      scene.observations[i].uv_px += Eigen::Vector2d(1.6, 1.2);
    }
    const Se3 start = NearbyPose(scene.T_world_camera, seed);
    const Se3& truth = scene.T_world_camera;
    with_kernel += Difference(truth, Solve(scene, start).T_world_camera).angle_rad;
    without += Difference(truth, Solve(scene, start, kLeastSquares).T_world_camera).angle_rad;
  }
  EXPECT_LT(with_kernel, 0.5 * without);
}

TEST(OptimizePose, FindsOutliersWhenThirtyPercentAreWrong) {
  PoseScene scene = MakePoseScene(200, 0.5, 3);
  Rng rng(3);
  for (std::size_t i = 0; i < 60; ++i) {
    scene.observations[i].uv_px += Eigen::Vector2d(rng.Uniform(15.0, 80.0), -20.0);
  }
  const PoseSolution solution = Solve(scene, NearbyPose(scene.T_world_camera, 3));
  EXPECT_LT(Difference(solution.T_world_camera, scene.T_world_camera).distance_m, 0.005);
  for (std::size_t i = 0; i < 60; ++i)
    EXPECT_FALSE(solution.is_inlier[i]) << i;
  EXPECT_GE(solution.num_inliers, 138);
}

TEST(OptimizePose, RejectsAWrongDepthReading) {
  PoseScene scene = MakePoseScene(100, 0.0, 4);
  scene.observations[1].disparity_px += 10.0;
  const PoseSolution solution = Solve(scene, NearbyPose(scene.T_world_camera, 4));
  EXPECT_FALSE(solution.is_inlier[1]);
  EXPECT_EQ(solution.num_inliers, 99);
}

TEST(OptimizePose, IgnoresObservationsWhenTheyAreNotFinite) {
  PoseScene scene = MakePoseScene(100, 0.0, 5);
  scene.observations[0].p_world.x() = kNan;
  scene.observations[1].uv_px.y() = kNan;
  scene.observations[2].information_px = std::numeric_limits<double>::infinity();
  scene.observations[3].information_px = -1.0;
  scene.observations[4].disparity_px = kNan;  // keeps its pixel
  const PoseSolution solution = Solve(scene, NearbyPose(scene.T_world_camera, 5));
  EXPECT_LT(Difference(solution.T_world_camera, scene.T_world_camera).distance_m, 1e-6);
  EXPECT_EQ(solution.num_inliers, 96);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_FALSE(solution.is_inlier[i]) << i;
  EXPECT_TRUE(solution.is_inlier[4]);
}

TEST(OptimizePose, IgnoresPointsWhenTheyLieBehindTheCamera) {
  PoseScene scene = MakePoseScene(60, 0.0, 6);
  for (std::size_t i = 0; i < 5; ++i) {
    scene.observations[i].p_world = scene.T_world_camera * Eigen::Vector3d(0.1, 0.2, -1.0);
  }
  const PoseSolution solution = Solve(scene, NearbyPose(scene.T_world_camera, 6));
  EXPECT_LT(Difference(solution.T_world_camera, scene.T_world_camera).distance_m, 1e-6);
  EXPECT_EQ(solution.num_inliers, 55);
}

TEST(OptimizePose, ReturnsTheStartWhenThereAreTooFewObservations) {
  for (const int count : {0, 1, 2}) {
    const PoseScene scene = MakePoseScene(count, 0.0, 7);
    const PoseSolution solution = Solve(scene, scene.T_world_camera);
    EXPECT_EQ(Difference(solution.T_world_camera, scene.T_world_camera).distance_m, 0.0);
    EXPECT_EQ(solution.num_inliers, count);
    EXPECT_EQ(solution.is_inlier.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(solution.iterations, 0);
  }
}

TEST(OptimizePose, ReturnsTheStartWhenItIsNotFinite) {
  const PoseScene scene = MakePoseScene(20, 0.0, 8);
  Se3 start = scene.T_world_camera;
  start.translation.x() = kNan;
  const PoseSolution solution = Solve(scene, start);
  EXPECT_EQ(solution.num_inliers, 0);
  EXPECT_EQ(solution.is_inlier.size(), 20U);
}

TEST(OptimizePose, StaysFiniteWhenAllObservationsAreTheSame) {
  PoseScene scene = MakePoseScene(30, 1.0, 9);
  for (PoseObservation& o : scene.observations)
    o = scene.observations.front();
  const PoseSolution solution = Solve(scene, NearbyPose(scene.T_world_camera, 9));
  EXPECT_TRUE(solution.T_world_camera.IsFinite());
  EXPECT_LT(Difference(solution.T_world_camera, scene.T_world_camera).distance_m, 1.0);
}

TEST(OptimizePose, RepeatsBitForBit) {
  const PoseScene scene = MakePoseScene(150, 1.0, 10);
  const Se3 start = NearbyPose(scene.T_world_camera, 10);
  const PoseSolution first = Solve(scene, start);
  const PoseSolution second = Solve(scene, start);
  EXPECT_EQ(first.T_world_camera.rotation.coeffs(), second.T_world_camera.rotation.coeffs());
  EXPECT_EQ(first.T_world_camera.translation, second.T_world_camera.translation);
  EXPECT_EQ(first.information, second.information);
}

TEST(OptimizePose, NeverTakesMoreIterationsThanAllowed) {
  const PoseScene scene = MakePoseScene(100, 1.0, 11);
  const PoseOptimizerOptions options{.rounds = 3, .iterations_per_round = 1};
  const PoseSolution solution = OptimizePose(
      scene.camera, kBaseline, NearbyPose(scene.T_world_camera, 11), scene.observations, options);
  EXPECT_GE(solution.iterations, 1);
  EXPECT_LE(solution.iterations, 3);
}

TEST(PoseOptimizerOptions, DefaultsLieInTheirRanges) {
  PoseOptimizerOptions options;
  OptionList list;
  Describe(list, options);
  EXPECT_EQ(list.entries().size(), 5U);
  EXPECT_NO_THROW(list.CheckRanges());
}

}  // namespace
}  // namespace cslam
