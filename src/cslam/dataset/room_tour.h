// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/handheld_motion.h"
#include "cslam/sim/camera_motion.h"

#include <Eigen/Core>

#include <functional>
#include <utility>
#include <vector>

namespace cslam {

// A walk on a circle with the gaze outwards and a little ahead.
struct RingWalk {
  Eigen::Vector2d center_m = Eigen::Vector2d::Zero();
  double radius_m = 1.0;
  double height_m = 1.2;
  double from_deg = 0.0;   // direction from the centre to the camera; 0 is world +x
  double to_deg = 360.0;   // smaller than from_deg: clockwise
  double lead_deg = 25.0;  // how far the gaze is turned towards the way
  double pitch_deg = -8.0;
};

// Its views from start_s to end_s.
std::vector<TimedView> RingViews(const RingWalk& ring, double start_s, double end_s);

// Motions played one after the other; between them the camera jumps.
CameraMotion OneAfterTheOther(std::vector<CameraMotion> parts);

// Straight lines between (time, value) points in order of time, level before and after them.
std::function<double(double time_s)> PiecewiseLinear(std::vector<std::pair<double, double>> points);

}  // namespace cslam
