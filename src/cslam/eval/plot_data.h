// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/eval/trajectory_plot.h"

#include <Eigen/Core>

#include <limits>
#include <string>
#include <vector>

namespace cslam {

// One camera centre as it is drawn.
struct PlotPoint {
  double time_s = 0.0;                              // since the first estimated pose
  Eigen::Vector2d top_m = Eigen::Vector2d::Zero();  // right and up on paper
  // Lower panel: error, or height where nothing is known about it. NaN: no value at this pose.
  double value_m = std::numeric_limits<double>::quiet_NaN();
};

// What a trajectory plot shows, without where on paper.
struct PlotData {
  std::vector<PlotPoint> reference;
  // One piece each time tracking went on without a gap.
  std::vector<std::vector<PlotPoint>> estimate;
  std::string right_axis = "x [m]";
  std::string up_axis = "y [m]";
  bool has_error = false;
};

PlotData PreparePlot(const TrajectoryPlot& plot);

}  // namespace cslam
