// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Synthetic scenes for the tests and benchmarks of this folder: a camera that goes round a box of
// points, with noisy measurements whose information is exact.

#include "cslam/optim/bundle_adjuster.h"
#include "cslam/optim/pose_optimizer.h"
#include "cslam/optim/residuals.h"
#include "cslam/util/random.h"

#include <numbers>
#include <vector>

namespace cslam::test {

inline constexpr double kBaseline = 0.08;       // metres
inline constexpr double kSigma = 0.7;           // px, of u and v
inline constexpr double kSigmaDisparity = 0.5;  // px

inline Camera TestCamera() {
  return {.width = 640, .height = 480, .fx = 525.0, .fy = 520.0, .cx = 319.5, .cy = 239.5};
}

inline Eigen::Vector3d GaussianVector(Rng& rng) {
  const double x = rng.Gaussian();
  const double y = rng.Gaussian();
  const double z = rng.Gaussian();
  return {x, y, z};
}

inline Se3 RandomMotion(Rng& rng, double sigma_rad, double sigma_m) {
  Vector6 tangent;
  tangent.head<3>() = sigma_rad * GaussianVector(rng);
  tangent.tail<3>() = sigma_m * GaussianVector(rng);
  return Exp(tangent);
}

// A point somewhere in the camera's view, 0.6 to 5 m away.
inline Eigen::Vector3d RandomVisiblePoint(const Camera& camera, Rng& rng) {
  const double u = rng.Uniform(0.0, camera.width);
  const double v = rng.Uniform(0.0, camera.height);
  return Unproject(camera, {u, v}, rng.Uniform(0.6, 5.0));
}

// PoseObservation or BaObservation of a point, with noise times the sigmas above.
template <typename Observation>
Observation Observe(const Camera& camera, const Eigen::Vector3d& p_camera, bool has_depth,
                    double noise, Rng& rng) {
  const Eigen::Vector3d uvd = PixelDisparityModel(camera, kBaseline).Predict(p_camera);
  const Eigen::Vector3d error = noise * GaussianVector(rng);
  Observation o;
  o.uv_px = uvd.head<2>() + kSigma * error.head<2>();
  o.disparity_px = has_depth ? std::max(0.0, uvd.z() + kSigmaDisparity * error.z()) : -1.0;
  o.information_px = 1.0 / (kSigma * kSigma);
  o.information_disparity = 1.0 / (kSigmaDisparity * kSigmaDisparity);
  return o;
}

struct PoseScene {
  Camera camera = TestCamera();
  Se3 T_world_camera;  // true
  std::vector<PoseObservation> observations;
};

// Four of five observations have depth.
inline PoseScene MakePoseScene(int num_observations, double noise, std::uint64_t seed) {
  Rng rng(seed);
  PoseScene scene;
  scene.T_world_camera = RandomMotion(rng, 1.0, 2.0);
  for (int i = 0; i < num_observations; ++i) {
    const Eigen::Vector3d p_camera = RandomVisiblePoint(scene.camera, rng);
    scene.observations.push_back(
        Observe<PoseObservation>(scene.camera, p_camera, i % 5 != 0, noise, rng));
    scene.observations.back().p_world = scene.T_world_camera * p_camera;
  }
  return scene;
}

struct BaScene {
  BaProblem problem;  // the first num_fixed poses are fixed; all are at their true places
  std::vector<Eigen::Vector3d> true_points;
};

struct BaSceneSize {
  int num_free = 6;
  int num_fixed = 2;
  int num_points = 200;
  int observations_per_point = 5;
};

// Cameras side by side on an arc of 1.5 m, all looking at the points. Each point is seen by
// observations_per_point of them, the poses taking turns.
inline BaScene MakeBaScene(const BaSceneSize& size, double noise, std::uint64_t seed) {
  Rng rng(seed);
  BaScene scene;
  BaProblem& problem = scene.problem;
  problem.camera = TestCamera();
  problem.baseline_m = kBaseline;
  const int num_poses = size.num_free + size.num_fixed;
  for (int i = 0; i < num_poses; ++i) {
    const double share = num_poses > 1 ? static_cast<double>(i) / (num_poses - 1) - 0.5 : 0.0;
    const Eigen::Vector3d rotation(0.02 * rng.Gaussian(), -0.3 * share, 0.02 * rng.Gaussian());
    const Eigen::Vector3d position(1.5 * share, 0.1 * rng.Gaussian(), 0.1 * rng.Gaussian());
    problem.T_world_camera.emplace_back(ExpSo3(rotation), position);
  }
  // Every k-th pose is fixed, so that none is far from one.
  problem.pose_is_fixed.assign(problem.T_world_camera.size(), 0);
  for (int i = 0; i < size.num_fixed; ++i) {
    problem.pose_is_fixed[static_cast<std::size_t>(i * num_poses / size.num_fixed)] = 1;
  }
  for (int point = 0; point < size.num_points; ++point) {
    const Eigen::Vector3d p_world(rng.Uniform(-1.0, 1.0), rng.Uniform(-0.8, 0.8),
                                  rng.Uniform(1.5, 4.0));
    problem.p_world.push_back(p_world);
    for (int k = 0; k < size.observations_per_point; ++k) {
      const int pose = (point + k) % num_poses;
      const Se3& T_world_camera = problem.T_world_camera[static_cast<std::size_t>(pose)];
      auto o = Observe<BaObservation>(problem.camera, T_world_camera.Inverse() * p_world,
                                      (point + k) % 5 != 0, noise, rng);
      o.pose = pose;
      o.point = point;
      problem.observations.push_back(o);
    }
  }
  scene.true_points = problem.p_world;
  return scene;
}

// Moves the free poses and the points away from where they are.
inline BaProblem Perturbed(const BaProblem& problem, double sigma_rad, double sigma_m,
                           std::uint64_t seed) {
  Rng rng(seed);
  BaProblem perturbed = problem;
  for (std::size_t i = 0; i < perturbed.T_world_camera.size(); ++i) {
    if (perturbed.pose_is_fixed[i]) continue;
    perturbed.T_world_camera[i] =
        perturbed.T_world_camera[i] * RandomMotion(rng, sigma_rad, sigma_m);
  }
  for (Eigen::Vector3d& p : perturbed.p_world)
    p += sigma_m * GaussianVector(rng);
  return perturbed;
}

}  // namespace cslam::test
