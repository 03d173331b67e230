// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/robot_set.h"
#include "cslam/dataset/robot_stories.h"

namespace cslam {
namespace {

// In the middle of a wall so long that its corners stay out of the pictures of the chair: the same
// plain wall and rug are all that is seen behind it in either place.
constexpr double kRoomLengthM = 8.6;
constexpr double kRoomWidthM = 6.5;
constexpr double kMoveM = 1.5;
const Eigen::Vector2d kFirstM(3.55, 5.75);
const Eigen::Vector2d kSecondM = kFirstM + Eigen::Vector2d(kMoveM, 0.0);
constexpr double kRugM = 0.012;  // what it stands on

// Where the arcs begin, relative to the chair, and their ends.
constexpr double kNearM = 1.3;
constexpr double kFarM = 1.65;
constexpr double kHalfArcDeg = 36.0;
const Eigen::Vector2d kBeforeChairM(0.0, -1.5);

// Looks at the chair from the left, the middle and the right, from afar and from near.
void LookAround(RobotPlan& plan, const Eigen::Vector2d& chair_m) {
  plan.Stand(5.0);
  plan.Orbit(chair_m, -kHalfArcDeg, kFarM);
  plan.Stand(4.0);
  plan.Orbit(chair_m, kHalfArcDeg, kNearM);
  plan.Stand(4.0);
  plan.Orbit(chair_m, kHalfArcDeg, kFarM);
  plan.Stand(4.0);
  plan.Orbit(chair_m, -kHalfArcDeg, 1.5);
  plan.Stand(3.0);
}

RobotRide LongRide(std::uint64_t seed) {
  RobotPlan plan(kFirstM + kBeforeChairM, 90.0,
                 {.speed_mps = 0.18, .turn_dps = 36.0, .place_noise_m = 0.02}, seed);
  LookAround(plan, kFirstM);
  plan.Turn(180.0);  // the rest of the room, with the back to the chair
  plan.Stand(3.0);
  plan.Scan(80.0, 2);
  plan.Ride({{3.3, 3.2}, {3.6, 2.2}});
  plan.Stand(3.0);
  plan.Scan(85.0, 2);
  plan.StandForChange(10.0);
  plan.Scan(85.0, 2);
  plan.Ride({{4.4, 1.8}, {5.2, 2.2}});
  plan.Stand(3.0);
  plan.Scan(85.0, 2);
  plan.Ride({{5.3, 3.2}, kSecondM + kBeforeChairM});
  plan.Turn(180.0);
  LookAround(plan, kSecondM);
  plan.Ride({{4.7, 3.5}, {4.3, 2.7}});
  plan.Face(kFirstM);
  plan.Stand(4.0);
  plan.Face(kSecondM);
  plan.Stand(4.0);
  plan.Turn(360.0);
  plan.Ride({{3.6, 2.5}, {3.5, 3.4}});
  plan.Turn(-360.0);
  plan.Stand(3.0);
  return plan.Finish(kOneChairFigures.duration_s);
}

void GlanceAround(RobotPlan& plan, const Eigen::Vector2d& chair_m) {
  plan.Stand(1.0);
  plan.Orbit(chair_m, kHalfArcDeg, kFarM);
  plan.Stand(1.0);
  plan.Orbit(chair_m, -2.0 * kHalfArcDeg, 1.5);
  plan.Stand(1.0);
}

RobotRide ShortRide(std::uint64_t seed) {
  RobotPlan plan(kFirstM + kBeforeChairM, 90.0,
                 {.speed_mps = 0.45, .turn_dps = 58.0, .ramp_s = 0.5, .place_noise_m = 0.02}, seed);
  GlanceAround(plan, kFirstM);
  plan.RideAndFace({{3.5, 3.6}}, {3.9, 1.0});
  plan.StandForChange(1.0);
  plan.Scan(30.0, 1);
  plan.RideAndFace({{4.4, 3.5}, kSecondM + kBeforeChairM}, kSecondM);
  GlanceAround(plan, kSecondM);
  plan.RideAndFace({{4.2, 3.6}}, 0.5 * (kFirstM + kSecondM));
  plan.Stand(2.5);
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
