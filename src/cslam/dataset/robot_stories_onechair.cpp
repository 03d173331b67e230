// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/robot_set.h"
#include "cslam/dataset/robot_stories.h"

#include <cmath>
#include <numbers>

namespace cslam {
namespace {

// In the middle of a wall so long that its corners stay out of the pictures of the chair: the same
// plain wall and rug are all that is seen behind it in either place.
constexpr double kRoomLengthM = 8.6;
constexpr double kRoomWidthM = 6.5;
// Just clear of where it stood (it is 0.9 m wide), and no further than the drift of the way between
// two looks from the same side might explain to a loop closer: 0.3 m and 5 % of 12.4 m.
constexpr double kMoveM = 0.92;
const Eigen::Vector2d kFirstM(3.84, 5.75);
const Eigen::Vector2d kSecondM = kFirstM + Eigen::Vector2d(kMoveM, 0.0);
constexpr double kRugM = 0.012;  // what it stands on

// Where the arcs around the chair begin, relative to it, and their ends.
constexpr double kNearM = 1.3;
constexpr double kFarM = 1.65;
constexpr double kHalfArcDeg = 36.0;
const Eigen::Vector2d kBeforeChairM(0.0, -1.5);
constexpr double kGlanceM = 1.3;  // from how far the short form looks

// Where one stands to look at the chair from an angle to the right of its front (deg).
Eigen::Vector2d Viewpoint(const Eigen::Vector2d& chair_m, double to_right_deg, double distance_m) {
  const double angle = to_right_deg * std::numbers::pi / 180.0;
  return chair_m + distance_m * Eigen::Vector2d(std::sin(angle), -std::cos(angle));
}

// Looks at the chair from one side (1: right, -1: left), the middle and the other side, from afar
// and from near.
void LookAround(RobotPlan& plan, const Eigen::Vector2d& chair_m, double first_side) {
  plan.Stand(5.0);
  plan.Orbit(chair_m, first_side * kHalfArcDeg, kFarM);
  plan.Stand(4.0);
  plan.Orbit(chair_m, -first_side * kHalfArcDeg, kNearM);
  plan.Stand(4.0);
  plan.Orbit(chair_m, -first_side * kHalfArcDeg, kFarM);
  plan.Stand(4.0);
  plan.Orbit(chair_m, first_side * kHalfArcDeg, 1.5);
  plan.Stand(3.0);
}

// The second look begins on the side where the first one ended: so there is as much way as can be
// between two looks from the left.
RobotRide LongRide(std::uint64_t seed) {
  RobotPlan plan(kFirstM + kBeforeChairM, 90.0,
                 {.speed_mps = 0.18, .turn_dps = 36.0, .place_noise_m = 0.02}, seed);
  LookAround(plan, kFirstM, -1.0);
  plan.Turn(180.0);  // the rest of the room, with the back to the chair
  plan.Stand(3.0);
  plan.Scan(80.0, 2);
  plan.Ride({{2.9, 3.4}, {2.9, 2.2}});
  plan.Stand(3.0);
  plan.Scan(85.0, 2);
  plan.StandForChange(10.0);
  plan.Scan(85.0, 2);
  plan.Ride({{4.4, 1.6}, {5.9, 2.0}});
  plan.Stand(3.0);
  plan.Scan(85.0, 2);
  plan.Ride({{5.7, 3.4}, kSecondM + kBeforeChairM});
  plan.Turn(180.0);
  LookAround(plan, kSecondM, 1.0);
  plan.Ride({{4.5, 3.5}, {4.3, 2.7}});
  plan.Face(kFirstM);
  plan.Stand(4.0);
  plan.Face(kSecondM);
  plan.Stand(4.0);
  plan.Turn(360.0);
  plan.Turn(-360.0);
  plan.Stand(3.0);
  return plan.Finish(kOneChairFigures.duration_s);
}

// Both times from the right to the left, so that there is a long way between all equal views.
RobotRide ShortRide(std::uint64_t seed) {
  RobotPlan plan(Viewpoint(kFirstM, kHalfArcDeg, kGlanceM), 90.0 + kHalfArcDeg,
                 {.speed_mps = 0.49, .turn_dps = 58.0, .ramp_s = 0.5, .place_noise_m = 0.02}, seed);
  plan.Stand(1.2);
  plan.Orbit(kFirstM, -2.0 * kHalfArcDeg, kGlanceM);
  plan.Stand(0.6);
  plan.RideAndFace({{2.9, 3.5}, {1.8, 3.0}, {2.1, 1.7}}, {4.3, 0.0});
  plan.StandForChange(0.8);
  plan.RideAndFace({{4.6, 1.4}, {6.5, 1.8}, {6.8, 3.3}, Viewpoint(kSecondM, kHalfArcDeg, kGlanceM)},
                   kSecondM);
  plan.Stand(0.6);
  plan.Orbit(kSecondM, -2.0 * kHalfArcDeg, kGlanceM);
  plan.Stand(1.2);
  plan.RideAndFace({{4.1, 3.8}}, 0.5 * (kFirstM + kSecondM));
  plan.Stand(2.0);
  return plan.Finish(kOneChairFigures.short_duration_s);
}

}  // namespace

Story MakeOneChairStory(const Stage& stage, const StoryOptions& options) {
  const RobotRide ride = options.is_short ? ShortRide(options.seed) : LongRide(options.seed);
  RobotSet set(stage, options,
               {.size_m = {kRoomLengthM, kRoomWidthM}, .palette = 0, .plain_north = true});
  // The same turn in both places: the second look shall be like the first one.
  const Se3 T_world_first = Standing(0.0, 0.0, kRugM) * set.Spot(kFirstM);
  SetPiece chair = set.Place(PropKind::kArmchair, set.AnyVariant(), "chair", T_world_first);
  SetPiece bear = set.PlaceOn(chair, PropKind::kTeddyBear, "teddy_bear");
  set.MoveWith(chair, {&bear}, ride.marks_s.at(0), Standing(kMoveM, 0.0, 0.0) * T_world_first);
  return set.Finish(ride);
}

}  // namespace cslam
