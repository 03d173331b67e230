// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/geometry/alignment.h"

#include "cslam/util/check.h"

#include <Eigen/SVD>

#include <cmath>
#include <vector>

namespace cslam {
namespace {

// Singular values of the covariance below this share of the largest count as zero.
constexpr double kRankTolerance = 1e-9;

struct PairStatistics {
  std::size_t num_points = 0;
  Eigen::Vector3d mean_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean_b = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_ab = Eigen::Matrix3d::Zero();  // mean of (a - mean_a)(b - mean_b)^T
  double variance_a = 0.0;                                  // mean of |a - mean_a|^2
  double variance_b = 0.0;                                  // mean of |b - mean_b|^2
};

bool IsUsable(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.allFinite() && b.allFinite();
}

PairStatistics Summarise(std::span<const Eigen::Vector3d> points_a,
                         std::span<const Eigen::Vector3d> points_b) {
  PairStatistics s;
  for (std::size_t i = 0; i < points_a.size(); ++i) {
    if (!IsUsable(points_a[i], points_b[i])) continue;
    ++s.num_points;
    s.mean_a += points_a[i];
    s.mean_b += points_b[i];
  }
  if (s.num_points == 0) return s;
  const double inverse_count = 1.0 / static_cast<double>(s.num_points);
  s.mean_a *= inverse_count;
  s.mean_b *= inverse_count;
  for (std::size_t i = 0; i < points_a.size(); ++i) {
    if (!IsUsable(points_a[i], points_b[i])) continue;
    const Eigen::Vector3d a = points_a[i] - s.mean_a;
    const Eigen::Vector3d b = points_b[i] - s.mean_b;
    s.covariance_ab += inverse_count * a * b.transpose();
    s.variance_a += inverse_count * a.squaredNorm();
    s.variance_b += inverse_count * b.squaredNorm();
  }
  return s;
}

// A point cloud this much smaller than its distance from the origin is one point, up to rounding.
bool IsOnePoint(double variance, const Eigen::Vector3d& mean) {
  constexpr double kRelativeRounding = 1e-13;
  return std::sqrt(variance) <= kRelativeRounding * mean.norm();
}

double Rmse(const Alignment& alignment, std::span<const Eigen::Vector3d> points_a,
            std::span<const Eigen::Vector3d> points_b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < points_a.size(); ++i) {
    if (!IsUsable(points_a[i], points_b[i])) continue;
    sum += (points_a[i] - alignment * points_b[i]).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(alignment.num_points));
}

}  // namespace

Eigen::Vector3d operator*(const Alignment& alignment, const Eigen::Vector3d& p_b) {
  return alignment.scale * (alignment.T_a_b.rotation * p_b) + alignment.T_a_b.translation;
}

Alignment AlignPoints(std::span<const Eigen::Vector3d> points_a,
                      std::span<const Eigen::Vector3d> points_b, AlignmentScale scale) {
  CSLAM_CHECK(points_a.size() == points_b.size(), "{} points against {}", points_a.size(),
              points_b.size());
  const PairStatistics s = Summarise(points_a, points_b);
  Alignment result;
  result.num_points = s.num_points;
  if (s.num_points == 0) return result;

  const bool has_extent =
      !IsOnePoint(s.variance_a, s.mean_a) && !IsOnePoint(s.variance_b, s.mean_b);
  if (has_extent) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(s.covariance_ab,
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
    // A mirror image fits noisy or flat data best at times; the sign keeps the rotation proper.
    const bool is_mirrored = svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0;
    const Eigen::Vector3d sign(1.0, 1.0, is_mirrored ? -1.0 : 1.0);
    const Eigen::Matrix3d R_a_b = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
    result.T_a_b.rotation = Eigen::Quaterniond(R_a_b).normalized();
    if (scale == AlignmentScale::kEstimated) {
      result.scale = svd.singularValues().dot(sign) / s.variance_b;
    }
    result.is_unique =
        s.num_points >= 3 && svd.singularValues()(1) > kRankTolerance * svd.singularValues()(0);
  }
  result.T_a_b.translation = s.mean_a - result.scale * (result.T_a_b.rotation * s.mean_b);
  result.rmse_m = Rmse(result, points_a, points_b);
  return result;
}

}  // namespace cslam
