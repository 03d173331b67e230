// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/robot_motion.h"

#include "cslam/sim/camera_path.h"
#include "cslam/util/check.h"
#include "cslam/util/random.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

namespace cslam {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr int kTableSteps = 64;             // of a curve's length, per point
constexpr double kOrbitStepDeg = 8.0;       // between the points of a circle
constexpr double kLongestOrbitDeg = 170.0;  // beyond, the gaze's direction would be ambiguous
constexpr double kNoWay = 1e-6;             // m or rad: not worth a move
constexpr double kActivityStepS = 0.04;
constexpr double kFullSpeedMps = 0.25;  // at which the shaking reaches half its height
constexpr double kFullTurnRadps = 40.0 * kRadPerDeg;
constexpr double kShortestStretch = 0.3;  // pauses may shrink to this share of the plan

// Time for a way (m or rad) from rest to rest at no more than the given speed.
double TravelTime(double way, double speed, double ramp_s) {
  return way < kNoWay ? 0.0 : std::max(way / speed + ramp_s, 2.0 * ramp_s);
}

// Share of a way covered at a time: constant speed between two smooth ramps.
double Progress(double time_s, double duration_s, double ramp_s) {
  const auto ramped = [&](double t) {  // integral of smoothstep(t / ramp_s)
    const double x = std::clamp(t / ramp_s, 0.0, 1.0);
    return ramp_s * (x * x * x - 0.5 * x * x * x * x);
  };
  const double t = std::clamp(time_s, 0.0, duration_s);
  const double full_s = duration_s - ramp_s;
  if (t < ramp_s) return ramped(t) / full_s;
  if (t > duration_s - ramp_s) return 1.0 - ramped(duration_s - t) / full_s;
  return (t - 0.5 * ramp_s) / full_s;
}

double WrapRad(double angle) {
  return std::remainder(angle, 2.0 * std::numbers::pi);
}

double DirectionRad(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d d = to - from;
  return std::atan2(d.y(), d.x());
}

// A sum of sines of given frequencies with amplitude 1 at most.
double Hum(double time_s, double low_hz, double high_hz, Rng rng) {
  double sum = 0.0;
  for (const double amplitude : {0.5, 0.3, 0.2}) {
    const double frequency_hz = rng.Uniform(low_hz, high_hz);
    const double phase_rad = rng.Uniform(0.0, 2.0 * std::numbers::pi);
    sum += amplitude * std::sin(2.0 * std::numbers::pi * frequency_hz * time_s + phase_rad);
  }
  return sum;
}

// The floor's waves below 1 Hz and the wheels' rattle above 3 Hz, per axis.
Eigen::Vector3d Shake(double time_s, std::uint64_t seed, std::uint64_t purpose) {
  Eigen::Vector3d sum;
  for (int axis = 0; axis < 3; ++axis) {
    const auto stream = static_cast<std::uint64_t>(axis);
    sum[axis] = 0.7 * Hum(time_s, 0.4, 1.0, Rng(seed, stream, purpose)) +
                0.3 * Hum(time_s, 3.0, 8.0, Rng(seed, stream, purpose + 1));
  }
  return sum;
}

}  // namespace

FloorCurve::FloorCurve(std::vector<Eigen::Vector2d> points) : points_(std::move(points)) {
  CSLAM_CHECK(!points_.empty());
  lengths_m_.push_back(0.0);
  Eigen::Vector2d last = points_.front();
  const std::size_t steps = (points_.size() - 1) * kTableSteps;
  for (std::size_t i = 1; i <= steps; ++i) {
    const Eigen::Vector2d next = AtParameter(static_cast<double>(i) / kTableSteps);
    lengths_m_.push_back(lengths_m_.back() + (next - last).norm());
    last = next;
  }
}

Eigen::Vector2d FloorCurve::AtParameter(double u) const {
  if (points_.size() == 1) return points_.front();
  const auto spans = static_cast<double>(points_.size() - 1);
  const double at = std::clamp(std::floor(u), 0.0, spans - 1.0);
  const auto i = static_cast<std::size_t>(at);
  const double t = u - at;
  const Eigen::Vector2d& b = points_[i];
  const Eigen::Vector2d& c = points_[i + 1];
  const Eigen::Vector2d a = i > 0 ? points_[i - 1] : Eigen::Vector2d(2.0 * b - c);
  const Eigen::Vector2d d = i + 2 < points_.size() ? points_[i + 2] : Eigen::Vector2d(2.0 * c - b);
  // Catmull-Rom.
  return b + 0.5 * t *
                 ((c - a) + t * ((2.0 * a - 5.0 * b + 4.0 * c - d) + t * (3.0 * (b - c) + d - a)));
}

Eigen::Vector2d FloorCurve::At(double along_m) const {
  const auto above = std::ranges::upper_bound(lengths_m_, along_m);
  if (above == lengths_m_.begin()) return points_.front();
  if (above == lengths_m_.end()) return points_.back();
  const auto i = static_cast<std::size_t>(above - lengths_m_.begin());
  const double span_m = lengths_m_[i] - lengths_m_[i - 1];
  const double t = span_m > 0.0 ? (along_m - lengths_m_[i - 1]) / span_m : 0.0;
  return AtParameter((static_cast<double>(i - 1) + t) / kTableSteps);
}

// The legs one after the other; a pure function of time.
class RobotPlan::Timetable {
 public:
  Timetable(std::vector<Leg> legs, const RobotBody& body, std::uint64_t seed)
      : legs_(std::move(legs)), body_(body), seed_(seed) {
    for (const Leg& leg : legs_) {
      starts_s_.push_back(duration_s_);
      duration_s_ += leg.duration_s;
    }
  }

  double duration_s() const { return duration_s_; }

  std::vector<double> MarksS() const {
    std::vector<double> marks;
    for (std::size_t i = 0; i < legs_.size(); ++i)
      if (legs_[i].is_marked) marks.push_back(starts_s_[i] + 0.5 * legs_[i].duration_s);
    return marks;
  }

  Se3 T_world_camera(double time_s) const {
    const Place place = At(time_s);
    const double activity = Activity(time_s);
    const PathKey key{{place.position_m.x(), place.position_m.y(), body_.camera_height_m},
                      place.yaw_rad,
                      body_.camera_pitch_rad};
    const Eigen::Vector3d shift_m = activity * body_.shake_m * Shake(time_s, seed_, 51);
    const Eigen::Vector3d turn_rad = activity * body_.shake_rad * Shake(time_s, seed_, 53);
    return PoseAt(key) * Se3(ExpSo3(turn_rad), shift_m);
  }

 private:
  struct Place {
    Eigen::Vector2d position_m;
    double yaw_rad;
  };

  Place At(double time_s) const {
    const auto above = std::ranges::upper_bound(starts_s_, time_s);
    const auto i =
        static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, above - starts_s_.begin() - 1));
    const Leg& leg = legs_[i];
    const double progress =
        leg.is_pause ? 0.0 : Progress(time_s - starts_s_[i], leg.duration_s, leg.ramp_s);
    const Eigen::Vector2d position_m = leg.curve.At(progress * leg.curve.length_m());
    if (!leg.gaze_m) return {position_m, leg.yaw_rad + progress * leg.turn_rad};
    return {position_m, leg.yaw_rad + WrapRad(DirectionRad(position_m, *leg.gaze_m) - leg.yaw_rad)};
  }

  // 0 at rest, towards 1 in motion.
  double Activity(double time_s) const {
    const Place before = At(time_s - kActivityStepS);
    const Place after = At(time_s + kActivityStepS);
    const double motion = ((after.position_m - before.position_m).norm() / kFullSpeedMps +
                           std::abs(after.yaw_rad - before.yaw_rad) / kFullTurnRadps) /
                          (2.0 * kActivityStepS);
    return motion / (1.0 + motion);
  }

  std::vector<Leg> legs_;
  RobotBody body_;
  std::uint64_t seed_;
  std::vector<double> starts_s_;
  double duration_s_ = 0.0;
};

RobotPlan::RobotPlan(const Eigen::Vector2d& start_m, double heading_deg, const RobotPace& pace,
                     std::uint64_t seed)
    : pace_(pace), seed_(seed), position_m_(start_m), yaw_rad_(heading_deg * kRadPerDeg) {}

void RobotPlan::Stand(double seconds) {
  Pause(seconds, false);
}

void RobotPlan::StandForChange(double seconds) {
  Pause(seconds, true);
}

void RobotPlan::Pause(double seconds, bool is_marked) {
  legs_.push_back({seconds, 0.0, true, is_marked, FloorCurve({position_m_}), yaw_rad_, 0.0, {}});
  standing_s_ += seconds;
}

void RobotPlan::Turn(double by_deg) {
  Ride({}, by_deg);
}

void RobotPlan::Face(const Eigen::Vector2d& point_m) {
  Turn(WrapRad(DirectionRad(position_m_, point_m) - yaw_rad_) / kRadPerDeg);
}

void RobotPlan::Scan(double half_width_deg, int repeats) {
  Turn(half_width_deg);
  for (int i = 0; i < repeats; ++i) {
    Turn(-2.0 * half_width_deg);
    if (i + 1 < repeats) Turn(2.0 * half_width_deg);
  }
  Turn(half_width_deg);
}

void RobotPlan::Ride(const std::vector<Eigen::Vector2d>& through_m, double turning_deg) {
  Add({0.0,
       0.0,
       false,
       false,
       FloorCurve(WayThrough(through_m)),
       yaw_rad_,
       turning_deg * kRadPerDeg,
       {}});
}

void RobotPlan::RideAndFace(const std::vector<Eigen::Vector2d>& through_m,
                            const Eigen::Vector2d& point_m, int full_turns) {
  const Eigen::Vector2d end_m = WayThrough(through_m).back();
  Ride(through_m,
       WrapRad(DirectionRad(end_m, point_m) - yaw_rad_) / kRadPerDeg + 360.0 * full_turns);
}

void RobotPlan::Orbit(const Eigen::Vector2d& center_m, double by_deg, double radius_m) {
  CSLAM_CHECK(std::abs(by_deg) < kLongestOrbitDeg);
  Face(center_m);
  const Eigen::Vector2d arm = position_m_ - center_m;
  const double start_rad = std::atan2(arm.y(), arm.x());
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(by_deg) / kOrbitStepDeg)));
  std::vector<Eigen::Vector2d> points{position_m_};
  for (int i = 1; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    const double angle = start_rad + share * by_deg * kRadPerDeg;
    const double radius = arm.norm() + share * (radius_m - arm.norm());
    points.push_back(center_m + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  // The gaze turns exactly as far as the place does, seen from the centre.
  Add({0.0, 0.0, false, false, FloorCurve(std::move(points)), yaw_rad_, by_deg * kRadPerDeg,
       center_m});
}

void RobotPlan::Add(Leg leg) {
  const double turn = std::abs(leg.turn_rad);
  leg.ramp_s = pace_.ramp_s;
  leg.duration_s = std::max(TravelTime(leg.curve.length_m(), pace_.speed_mps, pace_.ramp_s),
                            TravelTime(turn, pace_.turn_dps * kRadPerDeg, pace_.ramp_s));
  if (leg.duration_s <= 0.0) return;
  position_m_ = leg.curve.At(leg.curve.length_m());
  yaw_rad_ = leg.yaw_rad + leg.turn_rad;
  length_m_ += leg.curve.length_m();
  turning_deg_ += turn / kRadPerDeg;
  moving_s_ += leg.duration_s;
  legs_.push_back(std::move(leg));
}

std::vector<Eigen::Vector2d> RobotPlan::WayThrough(
    const std::vector<Eigen::Vector2d>& places_m) const {
  Rng rng(seed_, legs_.size(), 55);
  const double noise_m = pace_.place_noise_m;
  std::vector<Eigen::Vector2d> way{position_m_};
  for (const Eigen::Vector2d& place : places_m) {
    const double dx = rng.Uniform(-noise_m, noise_m);
    const double dy = rng.Uniform(-noise_m, noise_m);
    way.emplace_back(place + Eigen::Vector2d(dx, dy));
  }
  return way;
}

RobotRide RobotPlan::Finish(double duration_s, const RobotBody& body) const {
  CSLAM_CHECK(!legs_.empty() && standing_s_ > 0.0);
  const double stretch = (duration_s - moving_s_) / standing_s_;
  CSLAM_CHECK(stretch > kShortestStretch,
              "{} s are too short: moving takes {} s, pauses {} s; {} m, {} deg", duration_s,
              moving_s_, standing_s_, length_m_, turning_deg_);
  std::vector<Leg> legs = legs_;
  for (Leg& leg : legs)
    if (leg.is_pause) leg.duration_s *= stretch;
  const auto timetable = std::make_shared<const Timetable>(std::move(legs), body, seed_);
  RobotRide ride;
  ride.camera.duration_s = duration_s;
  ride.camera.T_world_camera = [timetable](double t) { return timetable->T_world_camera(t); };
  ride.marks_s = timetable->MarksS();
  return ride;
}

}  // namespace cslam
