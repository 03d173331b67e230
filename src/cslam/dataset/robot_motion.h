// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/sim/camera_motion.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

namespace cslam {

// A smooth curve through points on the floor, followed by its length.
class FloorCurve {
 public:
  explicit FloorCurve(std::vector<Eigen::Vector2d> points);  // at least one; m

  double length_m() const { return lengths_m_.back(); }
  Eigen::Vector2d At(double along_m) const;  // clamped to the curve

 private:
  Eigen::Vector2d AtParameter(double u) const;  // 0: first point, 1: second, ...

  std::vector<Eigen::Vector2d> points_;
  std::vector<double> lengths_m_;  // up to parameter i / kTableSteps
};

struct RobotPace {
  double speed_mps = 0.25;     // at most, while it drives
  double turn_dps = 45.0;      // at most, while the camera pans or the robot turns on the spot
  double ramp_s = 0.7;         // from rest to full speed, and back
  double place_noise_m = 0.0;  // how far from the plan it comes to rest, at most, per axis
};

// How the camera sits on the robot, and how the ride shakes it.
struct RobotBody {
  double camera_height_m = 0.4;
  double camera_pitch_rad = 0.09;  // upwards, about 5 deg
  double shake_m = 0.0004;         // amplitude at full speed, nothing at rest
  double shake_rad = 0.0015;
};

// A ride of the robot, ready to be filmed.
struct RobotRide {
  CameraMotion camera;
  std::vector<double> marks_s;  // in the order they were set
};

// A small robot with a camera on a turning plate: it drives along curves and looks where it is
// told, on the spot or while it drives. Every move begins and ends at rest. Plane coordinates in m,
// directions in deg: 0 along +x, 90 along +y, turning left is positive.
class RobotPlan {
 public:
  RobotPlan(const Eigen::Vector2d& start_m, double heading_deg, const RobotPace& pace,
            std::uint64_t seed);

  const Eigen::Vector2d& position_m() const { return position_m_; }

  // Pauses share what is left of the time, in proportion to their seconds.
  void Stand(double seconds);
  // As above; the middle of the pause becomes a mark, counted from 0.
  void StandForChange(double seconds);

  void Turn(double by_deg);                       // on the spot
  void Face(const Eigen::Vector2d& point_m);      // turns there the shorter way
  void Scan(double half_width_deg, int repeats);  // left and right of where it looks, and back

  // Drives through the points, turning by an angle meanwhile.
  void Ride(const std::vector<Eigen::Vector2d>& through_m, double turning_deg = 0.0);
  // As above, so that in the end it looks at a point: the shorter way, and some full turns to the
  // left (negative: to the right) on top.
  void RideAndFace(const std::vector<Eigen::Vector2d>& through_m, const Eigen::Vector2d& point_m,
                   int full_turns = 0);
  // Drives along a circle (a spiral, if radius_m differs from the distance now) with the gaze on
  // its centre: by an angle around it, less than 170 deg, positive anticlockwise from above. Faces
  // the centre first.
  void Orbit(const Eigen::Vector2d& center_m, double by_deg, double radius_m);

  // Length (m) and turning (deg) of what is planned so far, without the shaking.
  double length_m() const { return length_m_; }
  double turning_deg() const { return turning_deg_; }
  // Time that moves and pauses take as planned.
  double moving_s() const { return moving_s_; }
  double standing_s() const { return standing_s_; }

  // The ride, its pauses stretched or shortened so that it lasts duration_s.
  RobotRide Finish(double duration_s, const RobotBody& body = {}) const;

 private:
  struct Leg {
    double duration_s = 0.0;
    double ramp_s = 0.0;
    bool is_pause = false;
    bool is_marked = false;
    FloorCurve curve;
    double yaw_rad = 0.0;                   // at its start
    double turn_rad = 0.0;                  // until its end
    std::optional<Eigen::Vector2d> gaze_m;  // looks there all the time, if set
  };
  class Timetable;

  void Pause(double seconds, bool is_marked);
  void Add(Leg leg);
  std::vector<Eigen::Vector2d> WayThrough(const std::vector<Eigen::Vector2d>& places_m) const;

  RobotPace pace_;
  std::uint64_t seed_;
  Eigen::Vector2d position_m_;
  double yaw_rad_;
  std::vector<Leg> legs_;
  double length_m_ = 0.0;
  double turning_deg_ = 0.0;
  double moving_s_ = 0.0;
  double standing_s_ = 0.0;
};

}  // namespace cslam
