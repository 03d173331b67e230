// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/optim/bundle_adjuster.h"

#include "cslam/optim/test_scene.h"
#include "cslam/util/check.h"
#include "cslam/util/options.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cslam {
namespace {

using test::BaScene;
using test::MakeBaScene;
using test::Perturbed;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const BundleAdjusterOptions kExact{
    .iterations_robust = 20, .iterations_final = 20, .function_tolerance = 1e-12};

double WorstPoseError(const BaResult& result, const BaScene& scene) {
  double worst = 0.0;
  for (std::size_t i = 0; i < result.T_world_camera.size(); ++i) {
    const PoseDifference d = Difference(result.T_world_camera[i], scene.problem.T_world_camera[i]);
    worst = std::max({worst, d.angle_rad, d.distance_m});
  }
  return worst;
}

double RmsPointError(const BaResult& result, const BaScene& scene) {
  double sum = 0.0;
  for (std::size_t i = 0; i < result.p_world.size(); ++i) {
    sum += (result.p_world[i] - scene.true_points[i]).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(result.p_world.size()));
}

std::size_t NumOutliers(const BaResult& result) {
  return static_cast<std::size_t>(
      std::count(result.is_outlier.begin(), result.is_outlier.end(), 1));
}

void ExpectSame(const Se3& a, const Se3& b) {
  EXPECT_EQ(a.rotation.coeffs(), b.rotation.coeffs());
  EXPECT_EQ(a.translation, b.translation);
}

TEST(AdjustBundle, RecoversTheSceneWhenDataIsExact) {
  const BaScene scene = MakeBaScene({}, 0.0, 1);
  const BaResult result = AdjustBundle(Perturbed(scene.problem, 0.01, 0.02, 1), kExact);
  EXPECT_LT(WorstPoseError(result, scene), 1e-6);
  EXPECT_LT(RmsPointError(result, scene), 1e-6);
  EXPECT_EQ(NumOutliers(result), 0U);
  EXPECT_GT(result.initial_cost, 1000.0);
  EXPECT_LT(result.final_cost, 1e-6);
  EXPECT_FALSE(result.was_stopped);
}

TEST(AdjustBundle, LeavesFixedPosesUntouched) {
  const BaScene scene = MakeBaScene({}, 1.0, 2);
  const BaProblem problem = Perturbed(scene.problem, 0.01, 0.02, 2);
  const BaResult result = AdjustBundle(problem, {});
  for (std::size_t i = 0; i < problem.T_world_camera.size(); ++i) {
    if (problem.pose_is_fixed[i]) {
      ExpectSame(result.T_world_camera[i], problem.T_world_camera[i]);
    } else {
      EXPECT_NE(result.T_world_camera[i].translation, problem.T_world_camera[i].translation);
    }
  }
}

constexpr double kLeastSquares = 1000.0;  // a kernel so wide that it is none

TEST(AdjustBundle, ErrsAsMuchAsTheNoiseAllows) {
  const BaScene scene = MakeBaScene({.num_points = 400}, 1.0, 3);
  const BaResult result =
      AdjustBundle(Perturbed(scene.problem, 0.01, 0.02, 3), {.kernel_chi2 = kLeastSquares});
  EXPECT_LT(WorstPoseError(result, scene), 0.01);
  EXPECT_LT(RmsPointError(result, scene), 0.05);
  // Measurements less unknowns is what half the sum of chi2 expects, twice; outliers lower it.
  const double num_measurements = 2000 * 2.8;
  const double num_unknowns = 400 * 3 + 6 * 6;
  EXPECT_NEAR(2.0 * result.final_cost, num_measurements - num_unknowns,
              0.12 * (num_measurements - num_unknowns));
  EXPECT_LT(NumOutliers(result), 100U);  // 5 % by the choice of the thresholds
}

TEST(AdjustBundle, EndsAtTheSameOptimumFromAnotherStart) {
  const BaScene scene = MakeBaScene({}, 0.5, 4);
  const BaResult a = AdjustBundle(Perturbed(scene.problem, 0.005, 0.01, 4), kExact);
  const BaResult b = AdjustBundle(scene.problem, kExact);
  ASSERT_EQ(a.is_outlier, b.is_outlier);
  EXPECT_NEAR(a.final_cost, b.final_cost, 1e-6 * b.final_cost);
  for (std::size_t i = 0; i < a.T_world_camera.size(); ++i) {
    EXPECT_LT(Difference(a.T_world_camera[i], b.T_world_camera[i]).distance_m, 1e-5);
  }
}

TEST(AdjustBundle, FindsOutliersWhenTenPercentAreWrong) {
  BaScene scene = MakeBaScene({}, 0.3, 5);
  std::vector<BaObservation>& observations = scene.problem.observations;
  for (std::size_t i = 0; i < observations.size(); i += 10) {
    observations[i].uv_px += Eigen::Vector2d(20.0, -15.0);
  }
  const BaResult result = AdjustBundle(Perturbed(scene.problem, 0.005, 0.01, 5), {});
  for (std::size_t i = 0; i < observations.size(); i += 10)
    EXPECT_TRUE(result.is_outlier[i]) << i;
  EXPECT_LT(NumOutliers(result), observations.size() / 10 + 10);
  EXPECT_LT(WorstPoseError(result, scene), 0.01);
}

TEST(AdjustBundle, MovesOnlyPointsWhenAllPosesAreFixed) {
  BaScene scene = MakeBaScene({}, 0.0, 6);
  std::fill(scene.problem.pose_is_fixed.begin(), scene.problem.pose_is_fixed.end(), 1);
  const BaResult result = AdjustBundle(Perturbed(scene.problem, 0.01, 0.02, 6), kExact);
  EXPECT_LT(RmsPointError(result, scene), 1e-6);
  EXPECT_EQ(WorstPoseError(result, scene), 0.0);
}

TEST(AdjustBundle, KeepsItsGaugeWhenNoPoseIsFixed) {
  const BaScene scene = MakeBaScene({.num_fixed = 0}, 0.0, 7);
  const BaResult result = AdjustBundle(Perturbed(scene.problem, 0.005, 0.005, 7), kExact);
  EXPECT_LT(result.final_cost, 1e-6);
  EXPECT_LT(WorstPoseError(result, scene), 0.05);
}

TEST(AdjustBundle, PlacesAPointFromOneViewWithDepth) {
  BaScene scene = MakeBaScene({.num_free = 0, .num_fixed = 1, .observations_per_point = 1}, 0.0, 8);
  for (BaObservation& o : scene.problem.observations) {
    o.disparity_px = scene.problem.camera.fx * test::kBaseline /
                     (scene.problem.T_world_camera[0].Inverse() *
                      scene.true_points[static_cast<std::size_t>(o.point)])
                         .z();
  }
  const BaResult result = AdjustBundle(Perturbed(scene.problem, 0.0, 0.02, 8), kExact);
  EXPECT_LT(RmsPointError(result, scene), 1e-6);
}

TEST(AdjustBundle, StaysFiniteWhenAPointHasOneViewWithoutDepth) {
  BaScene scene = MakeBaScene({}, 0.0, 9);
  std::erase_if(scene.problem.observations,
                [](const BaObservation& o) { return o.point == 3 && o.pose != 3; });
  for (BaObservation& o : scene.problem.observations) {
    if (o.point == 3) o.disparity_px = -1.0;
  }
  const BaResult result = AdjustBundle(Perturbed(scene.problem, 0.01, 0.02, 9), kExact);
  EXPECT_TRUE(result.p_world[3].allFinite());
  EXPECT_LT(WorstPoseError(result, scene), 1e-6);
}

TEST(AdjustBundle, ReturnsTheInputWhenThereAreNoObservations) {
  BaScene scene = MakeBaScene({}, 0.0, 10);
  scene.problem.observations.clear();
  const BaResult result = AdjustBundle(scene.problem, {});
  EXPECT_EQ(result.iterations, 0);
  EXPECT_TRUE(result.is_outlier.empty());
  EXPECT_LT(WorstPoseError(result, scene), 1e-12);
  EXPECT_EQ(result.p_world, scene.problem.p_world);
  EXPECT_TRUE(AdjustBundle(BaProblem{}, {}).T_world_camera.empty());
}

TEST(AdjustBundle, LeavesOutObservationsWhenTheyAreNotFinite) {
  BaScene scene = MakeBaScene({}, 0.0, 11);
  scene.problem = Perturbed(scene.problem, 0.005, 0.01, 11);
  scene.problem.observations[0].uv_px.x() = kNan;
  scene.problem.observations[7].information_px = kNan;
  scene.problem.p_world[5].y() = kNan;
  const BaResult result = AdjustBundle(scene.problem, kExact);
  EXPECT_EQ(NumOutliers(result), 7U);
  EXPECT_TRUE(result.is_outlier[0]);
  EXPECT_TRUE(result.is_outlier[7]);
  for (const Se3& T : result.T_world_camera)
    EXPECT_TRUE(T.IsFinite());
  EXPECT_LT(result.final_cost, 1e-6);
}

TEST(AdjustBundle, CallsPointsBehindTheCameraOutliers) {
  BaScene scene = MakeBaScene({}, 0.0, 12);
  scene.problem.p_world[4] = Eigen::Vector3d(0.0, 0.0, -2.0);
  const BaResult result = AdjustBundle(scene.problem, {});
  for (std::size_t i = 0; i < result.is_outlier.size(); ++i) {
    EXPECT_EQ(result.is_outlier[i], scene.problem.observations[i].point == 4) << i;
  }
}

TEST(AdjustBundle, StopsAtOnceWhenAskedBeforeTheFirstIteration) {
  const BaScene scene = MakeBaScene({}, 0.5, 13);
  const BaProblem problem = Perturbed(scene.problem, 0.01, 0.02, 13);
  const BaResult result = AdjustBundle(problem, {}, [] { return true; });
  EXPECT_TRUE(result.was_stopped);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_EQ(result.p_world, problem.p_world);
}

TEST(AdjustBundle, KeepsTheBestSoFarWhenStoppedOnTheWay) {
  const BaScene scene = MakeBaScene({}, 0.5, 14);
  const BaProblem problem = Perturbed(scene.problem, 0.01, 0.02, 14);
  int asked = 0;
  const BaResult result = AdjustBundle(problem, kExact, [&asked] { return ++asked > 2; });
  EXPECT_TRUE(result.was_stopped);
  EXPECT_EQ(result.iterations, 2);
  EXPECT_LT(AdjustBundle({.camera = problem.camera,
                          .baseline_m = problem.baseline_m,
                          .T_world_camera = result.T_world_camera,
                          .pose_is_fixed = problem.pose_is_fixed,
                          .p_world = result.p_world,
                          .observations = problem.observations},
                         kExact)
                .initial_cost,
            0.2 * result.initial_cost);
}

TEST(AdjustBundle, EndsEarlyOnceTheCostSettles) {
  const BaScene scene = MakeBaScene({}, 0.5, 15);
  const BaResult result = AdjustBundle(Perturbed(scene.problem, 0.005, 0.01, 15), {});
  EXPECT_LE(result.iterations, 8);
}

TEST(AdjustBundle, RepeatsBitForBit) {
  const BaScene scene = MakeBaScene({}, 1.0, 16);
  const BaProblem problem = Perturbed(scene.problem, 0.01, 0.02, 16);
  const BaResult a = AdjustBundle(problem, {});
  const BaResult b = AdjustBundle(problem, {});
  for (std::size_t i = 0; i < a.T_world_camera.size(); ++i) {
    ExpectSame(a.T_world_camera[i], b.T_world_camera[i]);
  }
  EXPECT_EQ(a.p_world, b.p_world);
  EXPECT_EQ(a.is_outlier, b.is_outlier);
}

TEST(AdjustBundle, SolvesWithTheSparseSolverWhenThereAreManyPoses) {
  const BaScene scene = MakeBaScene({.num_free = 70, .num_fixed = 2, .num_points = 300}, 0.0, 17);
  const BaProblem problem = Perturbed(scene.problem, 0.003, 0.005, 17);
  const BaResult result = AdjustBundle(problem, kExact);
  EXPECT_LT(WorstPoseError(result, scene), 1e-5);
  const BaResult again = AdjustBundle(problem, kExact);
  EXPECT_EQ(result.p_world, again.p_world);
  ExpectSame(result.T_world_camera[50], again.T_world_camera[50]);
}

TEST(AdjustBundle, ThrowsWhenAnIndexIsOutOfRange) {
  BaScene scene = MakeBaScene({}, 0.0, 18);
  scene.problem.observations[0].point = 200;
  EXPECT_THROW(AdjustBundle(scene.problem, {}), InternalError);
  scene.problem.observations[0].point = 0;
  scene.problem.observations[0].pose = -1;
  EXPECT_THROW(AdjustBundle(scene.problem, {}), InternalError);
  scene.problem.observations.clear();
  scene.problem.pose_is_fixed.pop_back();
  EXPECT_THROW(AdjustBundle(scene.problem, {}), InternalError);
}

TEST(BundleAdjusterOptions, DefaultsLieInTheirRanges) {
  BundleAdjusterOptions options;
  OptionList list;
  Describe(list, options);
  EXPECT_EQ(list.entries().size(), 6U);
  EXPECT_NO_THROW(list.CheckRanges());
}

}  // namespace
}  // namespace cslam
