// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/sim/camera_motion.h"
#include "cslam/sim/camera_path.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace cslam {

// A view the hand passes at a time. Positive roll turns the camera clockwise as it looks.
struct TimedView {
  double time_s = 0.0;
  PathKey view;
  double roll_rad = 0.0;
};

// What a hand that means to be still does: sway below 0.3 Hz, corrections about 1 Hz and a trace of
// tremor about 3 Hz. Amplitudes of the sway per axis; the others are shares of it.
struct HandTremor {
  double position_m = 0.0045;
  double rotation_rad = 0.009;
  std::uint64_t seed = 1;
};

// From view to view at even speed, with every change of speed spread over +-rounding_s; so the
// camera cuts corners a little. Stands still before the first view's time and after the last
// one's. The views are in order of time; velocity and acceleration are continuous.
CameraMotion HandheldMotion(std::vector<TimedView> views, double rounding_s,
                            const HandTremor& tremor);

// The camera motions of TUM's fr3 recordings, around `home`.
CameraMotion StaticHand(const PathKey& home, double duration_s, std::uint64_t seed);
// Along the axes, in a cube of about 0.8 m, at 0.2 m/s.
CameraMotion XyzHand(const PathKey& home, double duration_s, double mean_speed_m_s,
                     std::uint64_t seed);
// About the axes, at 21 deg/s and nearly in place (0.09 m/s).
CameraMotion RpyHand(const PathKey& home, double duration_s, std::uint64_t seed);
// On a half sphere of 1.2 m diameter before home's view, looking at its centre, at 0.22 m/s.
CameraMotion HalfsphereHand(const PathKey& home, double duration_s, std::uint64_t seed);

}  // namespace cslam
