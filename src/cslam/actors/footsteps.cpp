// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/actors/footsteps.h"

#include "cslam/actors/smooth_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace cslam {
namespace {

constexpr double kFirstLift = 0.4;      // steps into a bout
constexpr double kAhead = 1.28;         // steps that the body still goes to reach a footfall's side
constexpr double kMaxReach_m = 0.38;    // of a landing foot from the body: longer steps sink it
constexpr double kHalfTrack_m = 0.085;  // of the feet from the middle
constexpr double kToeOut_rad = 0.1;
constexpr double kSwingShare = 0.8;  // of the time of one step (0.4 of a cycle)
constexpr double kLongestSwing_s = 0.5;
constexpr double kShortestSwing_s = 0.2;
constexpr double kRoll_s = 0.3;      // heel-off to toe-off
constexpr double kFullRoll_s = 0.2;  // time it takes to rise fully
constexpr double kHeelStrike_s = 0.12;
constexpr double kFullStride_m = 1.3;  // the travel of a foot that shows the full gait
constexpr double kFullTrail_m = 0.45;  // of the body past the foot, for a full rise of the heel
constexpr double kToeOff_rad = 0.9;
constexpr double kHeelStrike_rad = 0.33;
constexpr double kMinLift_m = 0.03;
constexpr double kGaitLift_m = 0.035;  // on top of it, at full stride

Footfall FallAt(const FloorPath& path, Side side, double time_s) {
  const FloorState body = path.At(time_s);
  const double aside_m = SignOf(side) * kHalfTrack_m;
  Footfall fall;
  fall.position_m =
      body.position_m + aside_m * Eigen::Vector2d(-std::sin(body.yaw_rad), std::cos(body.yaw_rad));
  fall.yaw_rad = body.yaw_rad + SignOf(side) * kToeOut_rad;
  return fall;
}

// How much of a full stride the way from one place to the next is, in the foot's direction.
double GaitOf(const Footfall& from, const Footfall& to) {
  const Eigen::Vector2d forward(std::cos(to.yaw_rad), std::sin(to.yaw_rad));
  return std::clamp((to.position_m - from.position_m).dot(forward) / kFullStride_m, 0.0, 1.0);
}

// Piecewise smooth between knots at rising x.
struct Knot {
  double x;
  double y;
};
double Blend(std::span<const Knot> knots, double x) {
  for (std::size_t i = 1; i < knots.size(); ++i) {
    if (x > knots[i].x) continue;
    return std::lerp(knots[i - 1].y, knots[i].y, SmoothStep(knots[i - 1].x, knots[i].x, x));
  }
  return knots.back().y;
}

Se3 SoleAt(const Eigen::Vector2d& position_m, double yaw_rad) {
  return Standing(position_m.x(), position_m.y(), 0.0, yaw_rad);
}

// The heel rises as far as the body has gone past the foot.
double RiseOf(const FloorPath& path, const Footfall& here, double lift_s) {
  const Eigen::Vector2d forward(std::cos(here.yaw_rad), std::sin(here.yaw_rad));
  const double past_m = (path.At(lift_s).position_m - here.position_m).dot(forward);
  return std::clamp(past_m / kFullTrail_m, 0.0, 1.0);
}

// How long the heel rises before the foot leaves.
double RollTime(const Footfall& here, const Footfall& next) {
  return std::min(kRoll_s, 0.5 * (next.lift_s - here.land_s));
}

// A short stance leaves no time to rise far.
double ToeOff(double roll_s) {
  return kToeOff_rad * std::min(1.0, roll_s / kFullRoll_s);
}

FootGoal Swing(const Footfall& from, const Footfall& to, double u) {
  const double gait = GaitOf(from, to);
  const double toe_off_rad = to.rise * ToeOff(RollTime(from, to));
  const double way = u * u * u * (10.0 + u * (6.0 * u - 15.0));  // from rest to rest
  // The heel has risen before the foot leaves, so the foot sets off fast and lands gently.
  const double eased = std::lerp(way, SmoothStep(0.0, 1.0, u), 0.6);
  const std::array<Knot, 5> pitch{{{0.0, toe_off_rad},
                                   {0.15, 1.1 * toe_off_rad},
                                   {0.6, 0.1 * gait},
                                   {0.85, -0.9 * gait * kHeelStrike_rad},
                                   {1.0, -gait * kHeelStrike_rad}}};
  FootGoal goal;
  goal.T_world_sole = SoleAt(from.position_m + eased * (to.position_m - from.position_m),
                             std::lerp(from.yaw_rad, to.yaw_rad, eased));
  goal.pitch_rad = Blend(pitch, u);
  goal.toe_bend_rad = std::max(0.0, goal.pitch_rad) * (1.0 - SmoothStep(0.0, 0.6, u));
  const double rise = std::sin(std::numbers::pi * u);
  goal.lift_m = (kMinLift_m + kGaitLift_m * gait) * rise * std::sqrt(std::max(0.0, rise));
  return goal;
}

}  // namespace

Footsteps::Footsteps(const FloorPath& path) {
  const double start_s = path.from_s() - FloorPath::kMargin_s;
  for (const Side side : kSides) {
    Footfall first = FallAt(path, side, start_s);
    first.lift_s = first.land_s = -std::numeric_limits<double>::infinity();
    falls_[static_cast<std::size_t>(side)].push_back(first);
  }
  std::size_t foot = 0;
  for (const SteppingBout& bout : path.Bouts()) {
    for (int k = 0; k < bout.num_steps(); ++k, foot = 1 - foot) {
      const double lift = k + kFirstLift;
      Footfall fall = FallAt(path, kSides[foot], bout.TimeOfStep(lift + kAhead));
      fall.lift_s = bout.TimeOfStep(lift);
      const double step_s = bout.TimeOfStep(lift + 1.0) - fall.lift_s;
      fall.land_s = fall.lift_s +
                    std::clamp(k + 1 < bout.num_steps() ? kSwingShare * step_s : kLongestSwing_s,
                               kShortestSwing_s, kLongestSwing_s);
      const Eigen::Vector2d body = path.At(fall.land_s).position_m;
      const Eigen::Vector2d reach = fall.position_m - body;
      fall.rise = RiseOf(path, falls_[foot].back(), fall.lift_s);
      fall.position_m = body + reach * std::min(1.0, kMaxReach_m / reach.norm());
      falls_[foot].push_back(fall);
    }
  }
}

FootGoal Footsteps::At(Side side, double time_s) const {
  const std::vector<Footfall>& falls = Of(side);
  const auto next = std::upper_bound(falls.begin() + 1, falls.end(), time_s,
                                     [](double t, const Footfall& f) { return t < f.lift_s; });
  const Footfall& here = *(next - 1);
  if (time_s < here.land_s) {
    return Swing(*(next - 2), here, (time_s - here.lift_s) / (here.land_s - here.lift_s));
  }
  FootGoal goal;
  goal.T_world_sole = SoleAt(here.position_m, here.yaw_rad);
  if (next - 1 != falls.begin()) {
    const double since = (time_s - here.land_s) / kHeelStrike_s;
    goal.pitch_rad -= GaitOf(*(next - 2), here) * kHeelStrike_rad * (1.0 - SmoothStep(0, 1, since));
  }
  if (next != falls.end()) {
    const double roll_s = RollTime(here, *next);
    const double rolled = SmoothStep(next->lift_s - roll_s, next->lift_s, time_s);
    goal.pitch_rad += next->rise * ToeOff(roll_s) * rolled;
  }
  goal.toe_bend_rad = std::max(0.0, goal.pitch_rad);
  return goal;
}

double Footsteps::Lift(Side side, double time_s) const {
  const std::vector<Footfall>& falls = Of(side);
  const auto next = std::upper_bound(falls.begin() + 1, falls.end(), time_s,
                                     [](double t, const Footfall& f) { return t < f.lift_s; });
  const Footfall& here = *(next - 1);
  if (!(time_s < here.land_s)) return 0.0;
  const double u = (time_s - here.lift_s) / (here.land_s - here.lift_s);
  const double rise = std::sin(std::numbers::pi * u);
  return rise * rise;
}

}  // namespace cslam
