// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/actors/floor_path.h"

#include "cslam/util/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace cslam {
namespace {

constexpr double kCornerWindow_s = 0.40;  // positions: mean over this, three times
constexpr double kTurnWindow_s = 0.45;    // the same for the direction
constexpr double kTurnRate_rad_s = 1.8;   // of an unhurried turn on the spot
constexpr double kSlow_m_s = 0.2;         // below, the direction of motion says nothing
constexpr double kStepRate_hz = 0.15;     // below, nobody steps
constexpr double kTurnPerStep_rad = 0.85;

// Mean over 2 * half + 1 neighbours; the ends repeat.
template <typename T>
std::vector<T> Averaged(const std::vector<T>& values, int half) {
  const auto n = static_cast<int>(values.size());
  std::vector<T> means;
  means.reserve(values.size());
  for (int i = 0; i < n; ++i) {
    T sum = values[static_cast<std::size_t>(std::clamp(i - half, 0, n - 1))];
    for (int j = i - half + 1; j <= i + half; ++j)
      sum += values[static_cast<std::size_t>(std::clamp(j, 0, n - 1))];
    means.push_back(sum / (2.0 * half + 1.0));
  }
  return means;
}

template <typename T>
std::vector<T> Smoothed(std::vector<T> values, double window_s) {
  const int half = static_cast<int>(std::lround(0.5 * window_s / FloorPath::kTick_s));
  for (int i = 0; i < 3; ++i)
    values = Averaged(values, half);
  return values;
}

// Straight lines between the points; beyond them the first and last go on.
Eigen::Vector2d OnPolyline(const std::vector<FloorPoint>& points, double time_s) {
  if (points.size() == 1) return points.front().position_m;
  const auto after = std::upper_bound(points.begin() + 1, points.end() - 1, time_s,
                                      [](double t, const FloorPoint& p) { return t < p.time_s; });
  const FloorPoint& b = *after;
  const FloorPoint& a = *(after - 1);
  const double alpha = (time_s - a.time_s) / (b.time_s - a.time_s);
  return a.position_m + alpha * (b.position_m - a.position_m);
}

double Wrapped(double angle_rad) {
  return std::remainder(angle_rad, 2.0 * std::numbers::pi);
}

// Length of a step at a walking speed: measured people lengthen both step and rate alike.
double StepLength_m(double speed_m_s) {
  return 0.38 + 0.26 * speed_m_s;
}

}  // namespace

double SteppingBout::to_s() const {
  return from_s + FloorPath::kTick_s * static_cast<double>(steps.size() - 1);
}

int SteppingBout::num_steps() const {
  return static_cast<int>(std::lround(steps.back()));
}

double SteppingBout::TimeOfStep(double step) const {
  const auto after = std::lower_bound(steps.begin(), steps.end(), step);
  if (after == steps.begin()) return from_s;
  if (after == steps.end()) return to_s();
  const double share = (step - *(after - 1)) / (*after - *(after - 1));
  return from_s + FloorPath::kTick_s * (static_cast<double>(after - steps.begin() - 1) + share);
}

FloorPath::FloorPath(std::vector<FloorPoint> points) : points_(std::move(points)) {
  CSLAM_CHECK(!points_.empty());
  for (std::size_t i = 1; i < points_.size(); ++i)
    CSLAM_CHECK(points_[i - 1].time_s < points_[i].time_s, "point {} is not later", i);
  TabulatePositions();
  TabulateYaws();
}

double FloorPath::TimeOf(std::size_t tick) const {
  return from_s() - kMargin_s + kTick_s * static_cast<double>(tick);
}

void FloorPath::TabulatePositions() {
  const double length_s = to_s() - from_s() + 2.0 * kMargin_s;
  const auto num_ticks = static_cast<std::size_t>(std::ceil(length_s / kTick_s)) + 2;
  for (std::size_t i = 0; i < num_ticks; ++i)
    positions_.push_back(OnPolyline(points_, TimeOf(i)));
  positions_ = Smoothed(std::move(positions_), kCornerWindow_s);
}

Eigen::Vector2d FloorPath::VelocityAt(std::size_t tick) const {
  const std::size_t before = tick == 0 ? 0 : tick - 1;
  const std::size_t after = std::min(tick + 1, positions_.size() - 1);
  return (positions_[after] - positions_[before]) / (kTick_s * static_cast<double>(after - before));
}

// Along the way where it moves. While it hardly does, it turns to where it is told to look, and,
// in the end, to where it will go.
void FloorPath::TabulateYaws() {
  const std::size_t n = positions_.size();
  yaws_.assign(n, 0.0);
  std::optional<double> yaw;
  const auto turn_by = [&](double from_rad, double to_rad) { return Wrapped(to_rad - from_rad); };
  for (std::size_t i = 0; i < n;) {
    const Eigen::Vector2d velocity = VelocityAt(i);
    if (velocity.norm() >= kSlow_m_s) {
      const double heading = std::atan2(velocity.y(), velocity.x());
      yaw = yaw ? *yaw + turn_by(*yaw, heading) : heading;
      yaws_[i++] = *yaw;
      continue;
    }
    std::size_t end = i;
    while (end < n && VelocityAt(end).norm() < kSlow_m_s)
      ++end;
    std::optional<double> leaving;
    if (end < n) leaving = std::atan2(VelocityAt(end).y(), VelocityAt(end).x());
    std::optional<double> facing;
    for (const FloorPoint& point : points_) {
      const bool here = point.time_s > TimeOf(i) - 0.5 && point.time_s < TimeOf(end - 1) + 0.5;
      if (here && point.facing_rad && !facing) facing = point.facing_rad;
    }
    const double first = yaw ? *yaw : facing.value_or(leaving.value_or(0.0));
    const double rest = facing ? first + turn_by(first, *facing) : first;
    const double last = leaving ? rest + turn_by(rest, *leaving) : rest;
    const double from = TimeOf(i);
    const double to = TimeOf(end - 1) + kTick_s;
    const double turn_in_s = std::min(std::abs(rest - first) / kTurnRate_rad_s, 0.5 * (to - from));
    const double turn_out_s = std::min(std::abs(last - rest) / kTurnRate_rad_s, to - from);
    for (; i < end; ++i) {
      const double t = TimeOf(i);
      const double in = turn_in_s > 0.0 ? std::clamp((t - from) / turn_in_s, 0.0, 1.0) : 1.0;
      const double out =
          turn_out_s > 0.0 ? std::clamp((t - to + turn_out_s) / turn_out_s, 0.0, 1.0) : 0.0;
      yaws_[i] = first + in * (rest - first) + out * (last - rest);
    }
    yaw = last;
  }
  yaws_ = Smoothed(std::move(yaws_), kTurnWindow_s);
}

FloorState FloorPath::At(double time_s) const {
  const double place = std::clamp((time_s - TimeOf(0)) / kTick_s, 0.0,
                                  static_cast<double>(positions_.size()) - 1.001);
  const auto i = static_cast<std::size_t>(place);
  const double alpha = place - static_cast<double>(i);
  FloorState state;
  state.position_m = positions_[i] + alpha * (positions_[i + 1] - positions_[i]);
  state.yaw_rad = yaws_[i] + alpha * (yaws_[i + 1] - yaws_[i]);
  state.speed_m_s =
      VelocityAt(i).norm() + alpha * (VelocityAt(i + 1).norm() - VelocityAt(i).norm());
  return state;
}

double FloorPath::StepRate(std::size_t tick) const {
  const double speed_m_s = VelocityAt(tick).norm();
  const std::size_t after = std::min(tick + 1, yaws_.size() - 1);
  const std::size_t before = tick == 0 ? 0 : tick - 1;
  const double turn_rad_s =
      std::abs(yaws_[after] - yaws_[before]) / (kTick_s * static_cast<double>(after - before));
  return std::hypot(speed_m_s / StepLength_m(speed_m_s), turn_rad_s / kTurnPerStep_rad);
}

std::vector<SteppingBout> FloorPath::Bouts() const {
  std::vector<SteppingBout> bouts;
  for (std::size_t i = 0; i < positions_.size();) {
    if (StepRate(i) < kStepRate_hz) {
      ++i;
      continue;
    }
    SteppingBout bout;
    bout.from_s = TimeOf(i);
    double steps = 0.0;
    for (; i < positions_.size() && StepRate(i) >= kStepRate_hz; ++i) {
      bout.steps.push_back(steps);
      steps += kTick_s * StepRate(i);
    }
    bout.steps.push_back(steps);
    const double whole = std::max(1.0, std::round(steps));
    for (double& step : bout.steps)
      step *= whole / steps;
    bouts.push_back(std::move(bout));
  }
  return bouts;
}

}  // namespace cslam
