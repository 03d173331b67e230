// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"

#include <cstddef>
#include <span>

namespace cslam {

enum class AlignmentScale { kFixedToOne, kEstimated };

// Maps b onto a: p_a = scale * (T_a_b.rotation * p_b) + T_a_b.translation.
struct Alignment {
  Se3 T_a_b;
  double scale = 1.0;
  double rmse_m = 0.0;         // of the aligned pairs
  std::size_t num_points = 0;  // pairs used; pairs with a non-finite coordinate are left out
  // False if the pairs leave the rotation open (fewer than three, all on one point or line): the
  // rotation is then one of those that fit best.
  bool is_unique = false;
};

Eigen::Vector3d operator*(const Alignment& alignment, const Eigen::Vector3d& p_b);

// Least-squares alignment of paired points (Umeyama 1991). The spans must have the same length.
// Without any pair: identity; with one: a translation.
Alignment AlignPoints(std::span<const Eigen::Vector3d> points_a,
                      std::span<const Eigen::Vector3d> points_b,
                      AlignmentScale scale = AlignmentScale::kFixedToOne);

}  // namespace cslam
