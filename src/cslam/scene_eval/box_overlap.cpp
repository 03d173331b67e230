// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/scene_eval/box_overlap.h"

#include <Eigen/Core>

namespace cslam {
namespace {

constexpr int kNumPoints = 20000;
// Additive recurrence with powers of the root of x^4 = x + 1: fills the unit cube evenly, and
// unlike a grid has no planes of points that a box's side could coincide with.
constexpr double kRoot = 1.22074408460575947536;

// Share of a's volume that is in b.
double ShareInside(const PlacedBox& a, const PlacedBox& b) {
  const Se3 T_b_a = b.T_world_box.Inverse() * a.T_world_box;
  const Eigen::Array3d step(1.0 / kRoot, 1.0 / (kRoot * kRoot), 1.0 / (kRoot * kRoot * kRoot));
  int num_inside = 0;
  for (int i = 0; i < kNumPoints; ++i) {
    const Eigen::Array3d turn = 0.5 + static_cast<double>(i) * step;
    const Eigen::Vector3d share = turn - turn.floor() - 0.5;
    const Eigen::Vector3d p = T_b_a * Eigen::Vector3d(share.cwiseProduct(a.size_m));
    if (((p.cwiseAbs() - 0.5 * b.size_m).array() <= 0.0).all()) ++num_inside;
  }
  return static_cast<double>(num_inside) / kNumPoints;
}

}  // namespace

double IntersectionOverUnion(const PlacedBox& a, const PlacedBox& b) {
  const double volume_a = a.size_m.prod();
  const double volume_b = b.size_m.prod();
  if (volume_a <= 0.0 || volume_b <= 0.0) return 0.0;
  const double shared =
      volume_a <= volume_b ? volume_a * ShareInside(a, b) : volume_b * ShareInside(b, a);
  return shared / (volume_a + volume_b - shared);
}

}  // namespace cslam
