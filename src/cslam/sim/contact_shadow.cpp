// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/contact_shadow.h"

#include <algorithm>
#include <cmath>

namespace cslam {
namespace {

constexpr double kCellM = 0.2;        // a ball for the surface in each such cube
constexpr float kReachM = 0.7F;       // balls farther than this cast nothing
constexpr float kMaxDarkness = 0.5F;  // share of the display value a full cover takes
constexpr float kMinRadiusM = 0.03F;

struct Cell {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double sum_squared = 0.0;
  int count = 0;
};

// Vertices gathered into the cells of a grid; means and spreads become balls.
std::vector<Eigen::Vector4f> BallsOf(const PlacedObject& object,
                                     const Eigen::AlignedBox3d& bounds) {
  const Eigen::Array3i size =
      (bounds.sizes().array() / kCellM).floor().cast<int>().max(0) + Eigen::Array3i::Ones();
  std::vector<Cell> cells(static_cast<std::size_t>(size.prod()));
  for (const Eigen::Vector3d& p : object.positions_m) {
    const Eigen::Vector3d from_corner = p - bounds.min();
    const Eigen::Array3i at = (from_corner.array() / kCellM).cast<int>().min(size - 1);
    Cell& cell = cells[static_cast<std::size_t>((at.z() * size.y() + at.y()) * size.x() + at.x())];
    cell.sum += from_corner;
    cell.sum_squared += from_corner.squaredNorm();
    ++cell.count;
  }
  std::vector<Eigen::Vector4f> balls;
  for (const Cell& cell : cells) {
    if (cell.count == 0) continue;
    const Eigen::Vector3d mean = cell.sum / cell.count;
    const double variance = cell.sum_squared / cell.count - mean.squaredNorm();
    const Eigen::Vector3f center = (bounds.min() + mean).cast<float>();
    const float squared = std::max(kMinRadiusM * kMinRadiusM, static_cast<float>(variance));
    balls.emplace_back(center.x(), center.y(), center.z(), squared);
  }
  return balls;
}

}  // namespace

ContactShadow::ContactShadow(std::span<const PlacedObject> movers) {
  for (const PlacedObject& mover : movers) {
    const Eigen::AlignedBox3d bounds = BoundsOf(mover);
    if (bounds.isEmpty()) continue;
    const Eigen::Vector3f margin = Eigen::Vector3f::Constant(kReachM);
    clusters_.push_back({{bounds.min().cast<float>() - margin, bounds.max().cast<float>() + margin},
                         BallsOf(mover, bounds)});
  }
}

float ContactShadow::GainAt(const Eigen::Vector3f& p, const Eigen::Vector3f& normal) const {
  float open = 1.0F;
  for (const Cluster& cluster : clusters_) {
    if (!cluster.reach.contains(p)) continue;
    for (const Eigen::Vector4f& ball : cluster.balls) {
      const Eigen::Vector3f to_ball = ball.head<3>() - p;
      const float distance2 = to_ball.squaredNorm();
      if (distance2 >= kReachM * kReachM) continue;
      const float above = normal.dot(to_ball);
      if (above <= 0.0F) continue;
      const float distance = std::sqrt(distance2);
      const float fade = 1.0F - distance / kReachM;
      const float cover = ball.w() / std::max(distance2, ball.w()) * above / distance;
      open *= 1.0F - std::min(0.9F, cover * fade);
    }
  }
  return 1.0F - kMaxDarkness * (1.0F - open);
}

}  // namespace cslam
