// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"
#include "cslam/util/stamp.h"

#include <cstddef>
#include <vector>

namespace cslam {

struct StampedPose {
  Stamp stamp;
  Se3 T_world_camera;
};

// Poses in strictly increasing order of their stamps.
using Trajectory = std::vector<StampedPose>;

// Sum of the distances between consecutive camera centres, in metres.
inline double PathLength(const Trajectory& trajectory) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    length_m +=
        (trajectory[i].T_world_camera.translation - trajectory[i - 1].T_world_camera.translation)
            .norm();
  }
  return length_m;
}

}  // namespace cslam
