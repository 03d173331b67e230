// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"
#include "cslam/sim/camera_motion.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace cslam {

// Where the camera is and where it looks. Yaw 0 looks along world +x, pi/2 along +y; positive
// pitch looks up. Yaw may run on beyond a full turn.
struct PathKey {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m, world
  double yaw_rad = 0.0;
  double pitch_rad = 0.0;
};

// The small movements of a hand: sums of sines below 2 Hz, different for every seed.
struct HandWobble {
  double position_m = 0.004;    // amplitude per axis
  double rotation_rad = 0.006;  // amplitude per axis
  std::uint64_t seed = 1;
};

// A smooth journey: a cubic B-spline near (not through) the keys, evenly spaced in time, which
// starts and ends at rest at the first and last key.
class CameraPath {
 public:
  // At least one key; duration_s > 0.
  CameraPath(std::vector<PathKey> keys, double duration_s, const HandWobble& wobble);

  double duration_s() const { return duration_s_; }

  // Before 0 and after the end the camera stands still (but for the wobble).
  Se3 T_world_camera(double time_s) const;

  // The same motion as a value of its own.
  CameraMotion Motion() const;

 private:
  PathKey SmoothKey(double time_s) const;

  std::vector<PathKey> keys_;  // with repeated ends
  double duration_s_;
  HandWobble wobble_;
};

// The pose of a camera (x right, y down, z forward) at a key.
Se3 PoseAt(const PathKey& key);

}  // namespace cslam
