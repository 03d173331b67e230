// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/pose_ransac.h"

#include "cslam/geometry/alignment.h"
#include "cslam/optim/residuals.h"
#include "cslam/util/options.h"
#include "cslam/util/random.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace cslam {
namespace {

using Triple = std::array<std::size_t, 3>;

// Real roots of a4 x^4 + ... + a0, as eigenvalues of the companion matrix.
std::vector<double> RealQuarticRoots(const std::array<double, 5>& a) {
  if (std::abs(a[4]) < 1e-12) return {};
  Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();
  companion.block<3, 3>(1, 0).setIdentity();
  for (int i = 0; i < 4; ++i)
    companion(i, 3) = -a[static_cast<std::size_t>(i)] / a[4];
  if (!companion.allFinite()) return {};
  const Eigen::EigenSolver<Eigen::Matrix4d> solver(companion, false);
  std::vector<double> roots;
  for (int i = 0; i < 4; ++i) {
    const auto root = solver.eigenvalues()[i];
    // A double root comes out as a pair with small imaginary parts.
    if (std::abs(root.imag()) < 1e-4 * (1.0 + std::abs(root.real()))) roots.push_back(root.real());
  }
  return roots;
}

// Grunert's quartic in v = d3 / d1, as in Haralick et al., "Review and analysis of solutions of the
// three point perspective pose estimation problem", 1994. Squared sides and cosines opposite each
// other: (a, alpha) between points 2 and 3, (b, beta) 1 and 3, (c, gamma) 1 and 2.
struct Grunert {
  double a2, b2, c2;
  double cos_alpha, cos_beta, cos_gamma;

  double q() const { return (a2 - c2) / b2; }

  std::array<double, 5> Quartic() const {
    const double sum = (a2 + c2) / b2;
    const double ca = cos_alpha, cb = cos_beta, cg = cos_gamma;
    const double qm = q();
    return {(1.0 + qm) * (1.0 + qm) - 4.0 * a2 / b2 * cg * cg,
            4.0 * (-qm * (1.0 + qm) * cb + 2.0 * a2 / b2 * cg * cg * cb - (1.0 - sum) * ca * cg),
            2.0 * (qm * qm - 1.0 + 2.0 * qm * qm * cb * cb + 2.0 * (b2 - c2) / b2 * ca * ca -
                   4.0 * sum * ca * cb * cg + 2.0 * (b2 - a2) / b2 * cg * cg),
            4.0 * (qm * (1.0 - qm) * cb - (1.0 - sum) * ca * cg + 2.0 * c2 / b2 * ca * ca * cb),
            (qm - 1.0) * (qm - 1.0) - 4.0 * c2 / b2 * ca * ca};
  }

  // Distances of the three points from the camera for a root v; none if one is negative.
  std::optional<Eigen::Vector3d> Distances(double v) const {
    const double denominator = 2.0 * (cos_gamma - v * cos_alpha);
    if (std::abs(denominator) < 1e-12) return std::nullopt;
    const double u = ((q() - 1.0) * v * v - 2.0 * q() * cos_beta * v + 1.0 + q()) / denominator;
    const double d1_squared = b2 / (1.0 + v * v - 2.0 * v * cos_beta);
    if (!(u > 0.0 && v > 0.0 && d1_squared > 0.0)) return std::nullopt;
    const double d1 = std::sqrt(d1_squared);
    return Eigen::Vector3d(d1, u * d1, v * d1);
  }
};

class PoseSearch {
 public:
  PoseSearch(const Camera& camera, double baseline_m, std::span<const PoseObservation> observations,
             const PoseRansacOptions& options)
      : camera_(camera),
        baseline_m_(baseline_m),
        observations_(observations),
        options_(options),
        model_(camera, baseline_m) {
    for (const PoseObservation& o : observations)
      measurements_.push_back(MeasurementOf(o));
  }

  PoseRansacResult Run(Rng rng) {
    const std::size_t n = observations_.size();
    best_.is_inlier.assign(n, 0);
    if (n < 3) return best_;
    double needed = options_.max_iterations;
    while (best_.iterations < needed && best_.iterations < options_.max_iterations) {
      ++best_.iterations;
      const Triple sample = Draw(rng, n);
      bool is_better = false;
      for (const Se3& T_world_camera : Hypotheses(sample))
        is_better = Offer(T_world_camera) || is_better;
      if (is_better) {
        Polish();
        needed = IterationsNeeded();
      }
    }
    return best_;
  }

 private:
  static Triple Draw(Rng& rng, std::size_t n) {
    Triple t{};
    t[0] = rng.Index(n);
    do
      t[1] = rng.Index(n);
    while (t[1] == t[0]);
    do
      t[2] = rng.Index(n);
    while (t[2] == t[0] || t[2] == t[1]);
    return t;
  }

  double DepthOf(std::size_t i) const {
    const double disparity = observations_[i].disparity_px;
    return disparity > 0.0 ? camera_.fx * baseline_m_ / disparity : 0.0;
  }

  std::vector<Se3> Hypotheses(const Triple& sample) const {
    std::array<Eigen::Vector3d, 3> p_world, rays, p_camera;
    int num_with_depth = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const PoseObservation& o = observations_[sample[k]];
      p_world[k] = o.p_world;
      rays[k] = Unproject(camera_, o.uv_px, 1.0);
      const double depth = DepthOf(sample[k]);
      if (depth > 0.0) ++num_with_depth;
      p_camera[k] = depth * rays[k];
    }
    if (!ShapesAgree(sample, p_world, p_camera)) return {};
    if (num_with_depth < 3) return SolveP3p(p_world, rays);
    const Alignment alignment = AlignPoints(p_world, p_camera);
    if (!alignment.is_unique) return {};
    return {alignment.T_a_b};
  }

  // Sides of the triangle must be as long in the world as the depth readings say.
  bool ShapesAgree(const Triple& sample, const std::array<Eigen::Vector3d, 3>& p_world,
                   const std::array<Eigen::Vector3d, 3>& p_camera) const {
    constexpr double kMinSide = 0.03;   // m; a smaller triangle leaves the rotation to noise
    constexpr double kMaxError = 0.05;  // m at 1 m; grows with the square of depth, as noise does
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3;
      const double side = (p_world[k] - p_world[l]).norm();
      if (side < kMinSide) return false;
      const double depth = std::max(DepthOf(sample[k]), DepthOf(sample[l]));
      if (DepthOf(sample[k]) <= 0.0 || DepthOf(sample[l]) <= 0.0) continue;
      const double max_error = kMaxError * std::max(1.0, depth * depth);
      if (std::abs((p_camera[k] - p_camera[l]).norm() - side) > max_error) return false;
    }
    return true;
  }

  bool IsInlier(const Se3& T_camera_world, std::size_t i) const {
    const Measurement& m = measurements_[i];
    return Chi2(model_, m, T_camera_world * observations_[i].p_world) <=
           (m.has_disparity ? options_.chi2_depth : options_.chi2_mono);
  }

  bool Offer(const Se3& T_world_camera) {
    const Se3 T_camera_world = T_world_camera.Inverse();
    if (!T_camera_world.IsFinite()) return false;
    std::vector<std::uint8_t> is_inlier(observations_.size());
    int count = 0;
    for (std::size_t i = 0; i < observations_.size(); ++i) {
      is_inlier[i] = IsInlier(T_camera_world, i) ? 1 : 0;
      count += is_inlier[i];
    }
    if (count < 3 || count <= best_.num_inliers) return false;
    best_.T_world_camera = T_world_camera;
    best_.is_inlier = std::move(is_inlier);
    best_.num_inliers = count;
    return true;
  }

  // A pose from three noisy points misses inliers that one from all of its inliers finds.
  void Polish() {
    constexpr int kMinInliers = 6;
    if (best_.num_inliers < kMinInliers) return;
    std::vector<PoseObservation> inliers;
    for (std::size_t i = 0; i < observations_.size(); ++i) {
      if (best_.is_inlier[i] != 0) inliers.push_back(observations_[i]);
    }
    const PoseOptimizerOptions pose{.rounds = 2,
                                    .iterations_per_round = 5,
                                    .chi2_mono = options_.chi2_mono,
                                    .chi2_depth = options_.chi2_depth};
    Offer(OptimizePose(camera_, baseline_m_, best_.T_world_camera, inliers, pose).T_world_camera);
  }

  double IterationsNeeded() const {
    const double share =
        static_cast<double>(best_.num_inliers) / static_cast<double>(observations_.size());
    const double all_good = std::min(std::pow(share, 3), 1.0 - 1e-9);
    return std::log(1.0 - options_.confidence) / std::log(1.0 - all_good);
  }

  const Camera& camera_;
  double baseline_m_;
  std::span<const PoseObservation> observations_;
  const PoseRansacOptions& options_;
  PixelDisparityModel model_;
  std::vector<Measurement> measurements_;
  PoseRansacResult best_;
};

}  // namespace

void Describe(OptionList& list, PoseRansacOptions& o) {
  list.Add("max_iterations", o.max_iterations, {10, 100'000}, "",
           "Samples of three matches tried at most for a pose.");
  list.Add("confidence", o.confidence, {0.5, 0.999999}, "",
           "Sampling ends once a sample without wrong matches was drawn with this probability.");
  list.Add("chi2_mono", o.chi2_mono, {0.1, 1000.0}, "",
           "Largest squared error of an inlier without depth, in units of sigma; 5.991 is the 95 % "
           "quantile, and blurred corners err by more.");
  list.Add("chi2_depth", o.chi2_depth, {0.1, 1000.0}, "",
           "The same with depth; 7.815 is the 95 % quantile.");
}

std::vector<Se3> SolveP3p(const std::array<Eigen::Vector3d, 3>& p_world,
                          const std::array<Eigen::Vector3d, 3>& rays) {
  const std::array<Eigen::Vector3d, 3> unit{rays[0].normalized(), rays[1].normalized(),
                                            rays[2].normalized()};
  const Grunert problem{.a2 = (p_world[1] - p_world[2]).squaredNorm(),
                        .b2 = (p_world[0] - p_world[2]).squaredNorm(),
                        .c2 = (p_world[0] - p_world[1]).squaredNorm(),
                        .cos_alpha = unit[1].dot(unit[2]),
                        .cos_beta = unit[0].dot(unit[2]),
                        .cos_gamma = unit[0].dot(unit[1])};
  if (!(std::min({problem.a2, problem.b2, problem.c2}) > 1e-12)) return {};
  std::vector<Se3> poses;
  for (const double v : RealQuarticRoots(problem.Quartic())) {
    const auto distances = problem.Distances(v);
    if (!distances) continue;
    std::array<Eigen::Vector3d, 3> p_camera;
    for (std::size_t k = 0; k < 3; ++k)
      p_camera[k] = (*distances)[static_cast<Eigen::Index>(k)] * unit[k];
    const Alignment alignment = AlignPoints(p_world, p_camera);
    if (alignment.is_unique) poses.push_back(alignment.T_a_b);
  }
  return poses;
}

PoseRansacResult FindPose(const Camera& camera, double baseline_m,
                          std::span<const PoseObservation> observations,
                          const PoseRansacOptions& options, std::uint64_t seed) {
  constexpr std::uint64_t kPurpose = 0x706F7365;
  return PoseSearch(camera, baseline_m, observations, options).Run(Rng(seed, 0, kPurpose));
}

}  // namespace cslam
