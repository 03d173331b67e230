// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/pose_ransac.h"

#include "cslam/optim/test_scene.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace cslam {
namespace {

using test::kBaseline;

TEST(SolveP3p, FindsTheTruePoseAmongItsSolutions) {
  Rng rng(3);
  for (int trial = 0; trial < 100; ++trial) {
    const Se3 T_world_camera = test::RandomMotion(rng, 1.0, 2.0);
    std::array<Eigen::Vector3d, 3> p_world, rays;
    for (std::size_t k = 0; k < 3; ++k) {
      rays[k] = test::RandomVisiblePoint(test::TestCamera(), rng);
      p_world[k] = T_world_camera * rays[k];
    }
    double nearest = 1.0;
    for (const Se3& found : SolveP3p(p_world, rays)) {
      const PoseDifference difference = Difference(T_world_camera, found);
      nearest = std::min(nearest, difference.distance_m + difference.angle_rad);
    }
    EXPECT_LT(nearest, 1e-4) << "trial " << trial;
  }
}

TEST(SolveP3p, FindsNothingWhenPointsCoincide) {
  const Eigen::Vector3d p(0.0, 0.0, 1.0);
  EXPECT_TRUE(SolveP3p({p, p, p}, {p, p, p}).empty());
}

// Every bad-th observation keeps its place and gets another's point.
test::PoseScene SceneWithWrongMatches(int num_observations, int good_of_ten, std::uint64_t seed) {
  test::PoseScene scene = test::MakePoseScene(num_observations, 1.0, seed);
  Rng rng(seed, 1);
  for (std::size_t i = 0; i < scene.observations.size(); ++i) {
    if (static_cast<int>(i % 10) < good_of_ten) continue;
    scene.observations[i].p_world =
        scene.T_world_camera * test::RandomVisiblePoint(scene.camera, rng);
  }
  return scene;
}

TEST(FindPose, FindsThePoseAmongSeventyPercentWrongMatches) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const test::PoseScene scene = SceneWithWrongMatches(150, 3, seed);
    const PoseRansacResult result = FindPose(scene.camera, kBaseline, scene.observations, {}, seed);
    const PoseDifference difference = Difference(scene.T_world_camera, result.T_world_camera);
    EXPECT_GE(result.num_inliers, 40);
    EXPECT_LT(difference.distance_m, 0.02);
    EXPECT_LT(difference.angle_rad, 0.01);
  }
}

TEST(FindPose, NeedsNoDepthWhenTheRaysSuffice) {
  test::PoseScene scene = SceneWithWrongMatches(100, 6, 7);
  for (PoseObservation& o : scene.observations)
    o.disparity_px = -1.0;
  const PoseRansacResult result = FindPose(scene.camera, kBaseline, scene.observations, {}, 7);
  EXPECT_LT(Difference(scene.T_world_camera, result.T_world_camera).distance_m, 0.03);
}

TEST(FindPose, FindsFewInliersWhenAllMatchesAreWrong) {
  const test::PoseScene scene = SceneWithWrongMatches(150, 0, 5);
  EXPECT_LT(FindPose(scene.camera, kBaseline, scene.observations, {}, 5).num_inliers, 12);
}

TEST(FindPose, StopsEarlyWhenMostMatchesAreRight) {
  const test::PoseScene scene = SceneWithWrongMatches(150, 9, 5);
  EXPECT_LT(FindPose(scene.camera, kBaseline, scene.observations, {}, 5).iterations, 20);
}

TEST(FindPose, FindsNothingInTwoMatches) {
  const test::PoseScene scene = test::MakePoseScene(2, 1.0, 1);
  EXPECT_EQ(FindPose(scene.camera, kBaseline, scene.observations, {}, 1).num_inliers, 0);
}

}  // namespace
}  // namespace cslam
