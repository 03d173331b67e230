// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/contact_shadow.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cslam {
namespace {

constexpr double kCellM = 0.2;        // a ball for the surface in each such cube
constexpr float kReachM = 0.7F;       // balls farther than this cast nothing
constexpr float kMaxDarkness = 0.5F;  // share of the display value a full cover takes
constexpr double kMaxRadiusM = 0.15;  // bodies have inner layers that hide nothing more

struct Cell {
  Eigen::Vector3d weighted_sum = Eigen::Vector3d::Zero();
  double area_m2 = 0.0;
};

// Triangles gathered into the cells of a grid. A patch of area A hides as much as a ball of radius
// sqrt(A / pi); about half of a body's surface faces any point.
std::vector<Eigen::Vector4f> BallsOf(const PlacedObject& object,
                                     const Eigen::AlignedBox3d& bounds) {
  const Eigen::Array3i size =
      (bounds.sizes().array() / kCellM).floor().cast<int>().max(0) + Eigen::Array3i::Ones();
  std::vector<Cell> cells(static_cast<std::size_t>(size.prod()));
  for (const Triangle& triangle : object.mesh->triangles) {
    const Eigen::Vector3d& a = object.positions_m[triangle.vertices[0]];
    const Eigen::Vector3d& b = object.positions_m[triangle.vertices[1]];
    const Eigen::Vector3d& c = object.positions_m[triangle.vertices[2]];
    const Eigen::Vector3d middle = (a + b + c) / 3.0;
    const double area_m2 = 0.5 * (b - a).cross(c - a).norm();
    const Eigen::Array3i at =
        ((middle - bounds.min()).array() / kCellM).cast<int>().max(0).min(size - 1);
    Cell& cell = cells[static_cast<std::size_t>((at.z() * size.y() + at.y()) * size.x() + at.x())];
    cell.weighted_sum += area_m2 * middle;
    cell.area_m2 += area_m2;
  }
  std::vector<Eigen::Vector4f> balls;
  for (const Cell& cell : cells) {
    if (cell.area_m2 <= 0.0) continue;
    const Eigen::Vector3f center = (cell.weighted_sum / cell.area_m2).cast<float>();
    const double squared_m2 =
        std::min(kMaxRadiusM * kMaxRadiusM, 0.5 * cell.area_m2 / std::numbers::pi);
    balls.emplace_back(center.x(), center.y(), center.z(), static_cast<float>(squared_m2));
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
