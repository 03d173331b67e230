// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/actors/floor_path.h"
#include "cslam/actors/person_pose.h"

#include <array>
#include <vector>

namespace cslam {

// One foot's place on the floor, and when it comes there.
struct Footfall {
  double lift_s = 0.0;  // leaves the former place
  double land_s = 0.0;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  double yaw_rad = 0.0;
  double rise = 0.0;  // of the heel before leaving the former place: 0 none, 1 as in a full stride
};

// Where the feet are while someone follows a path: planted, or swinging to the next place.
class Footsteps {
 public:
  explicit Footsteps(const FloorPath& path);

  FootGoal At(Side side, double time_s) const;

  // 0 on the floor, 1 in the middle of the swing.
  double Lift(Side side, double time_s) const;

 private:
  const std::vector<Footfall>& Of(Side side) const {
    return falls_[static_cast<std::size_t>(side)];
  }
  std::array<std::vector<Footfall>, 2> falls_;  // in order of time; the first holds from ever on
};

}  // namespace cslam
