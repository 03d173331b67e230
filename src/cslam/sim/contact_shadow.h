// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/sim/placed_object.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <span>
#include <vector>

namespace cslam {

// The soft shadow that moving things cast on what rests near them: how much of the surroundings
// they hide, taken as a cloud of balls.
class ContactShadow {
 public:
  explicit ContactShadow(std::span<const PlacedObject> movers);

  // Factor on the display values of a surface at p (m, world) with a unit normal.
  float GainAt(const Eigen::Vector3f& p, const Eigen::Vector3f& normal) const;

 private:
  struct Cluster {
    Eigen::AlignedBox3f reach;           // outside of it the balls do nothing
    std::vector<Eigen::Vector4f> balls;  // centre (m, world), squared radius (m2)
  };
  std::vector<Cluster> clusters_;  // one per mover
};

}  // namespace cslam
