// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/actors/person.h"

#include <Eigen/Core>

#include <vector>

namespace cslam {

// Where a walker is at a time.
struct FloorState {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  double yaw_rad = 0.0;  // unwrapped
  double speed_m_s = 0.0;
};

// A stretch of time in which the walker steps: the number of steps done, growing from 0.
struct SteppingBout {
  double from_s = 0.0;
  std::vector<double> steps;  // at from_s + i FloorPath::kTick_s
  double to_s() const;
  int num_steps() const;                 // whole: the last entry of steps
  double TimeOfStep(double step) const;  // the inverse, clamped to the bout
};

// The smooth way through timed points: corners rounded, starts and stops gentle, looking the way
// it goes. Tabulated once; asking is a pure function of time.
class FloorPath {
 public:
  static constexpr double kTick_s = 0.02;
  static constexpr double kMargin_s = 2.0;  // the way goes on so long before and after the points

  // At least one point, times strictly growing.
  explicit FloorPath(std::vector<FloorPoint> points);

  double from_s() const { return points_.front().time_s; }
  double to_s() const { return points_.back().time_s; }
  FloorState At(double time_s) const;
  std::vector<SteppingBout> Bouts() const;

 private:
  void TabulatePositions();
  void TabulateYaws();
  double StepRate(std::size_t tick) const;
  Eigen::Vector2d VelocityAt(std::size_t tick) const;
  double TimeOf(std::size_t tick) const;

  std::vector<FloorPoint> points_;
  std::vector<Eigen::Vector2d> positions_;  // per tick
  std::vector<double> yaws_;
};

}  // namespace cslam
