// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/scene_eval/box_overlap.h"

#include <Eigen/Core>

namespace cslam {
namespace {

constexpr int kPointsPerAxis = 24;

// Share of a's volume that is in b.
double ShareInside(const OrientedBox& a, const OrientedBox& b) {
  const Se3 T_b_a = b.T_world_box.Inverse() * a.T_world_box;
  const auto at = [](int i) { return (i + 0.5) / kPointsPerAxis - 0.5; };
  int num_inside = 0;
  for (int x = 0; x < kPointsPerAxis; ++x)
    for (int y = 0; y < kPointsPerAxis; ++y)
      for (int z = 0; z < kPointsPerAxis; ++z) {
        const Eigen::Vector3d share(at(x), at(y), at(z));
        const Eigen::Vector3d p = T_b_a * Eigen::Vector3d(share.cwiseProduct(a.size_m));
        if (((p.cwiseAbs() - 0.5 * b.size_m).array() <= 0.0).all()) ++num_inside;
      }
  constexpr double kNumPoints = 1.0 * kPointsPerAxis * kPointsPerAxis * kPointsPerAxis;
  return num_inside / kNumPoints;
}

}  // namespace

double IntersectionOverUnion(const OrientedBox& a, const OrientedBox& b) {
  const double volume_a = a.size_m.prod();
  const double volume_b = b.size_m.prod();
  if (volume_a <= 0.0 || volume_b <= 0.0) return 0.0;
  const double shared =
      volume_a <= volume_b ? volume_a * ShareInside(a, b) : volume_b * ShareInside(b, a);
  return shared / (volume_a + volume_b - shared);
}

}  // namespace cslam
