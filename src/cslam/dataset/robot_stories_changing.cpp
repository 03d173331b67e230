// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/robot_set.h"
#include "cslam/dataset/robot_stories.h"

namespace cslam {
namespace {

const Eigen::Vector2d kChairM(2.2, 4.5);
const Eigen::Vector2d kOtherChairM(4.4, 4.5);
const Eigen::Vector2d kUmbrellaM(3.3, 4.9);
const Eigen::Vector2d kOtherUmbrellaM(5.8, 3.4);

RobotRide LongRide(std::uint64_t seed) {
  RobotPlan plan({2.2, 2.4}, 90.0, {.speed_mps = 0.22, .turn_dps = 45.0, .place_noise_m = 0.02},
                 seed);
  plan.Stand(4.0);
  plan.Orbit(kChairM, 35.0, 1.7);
  plan.Stand(3.0);
  plan.Orbit(kChairM, -50.0, 1.9);
  plan.Stand(3.0);
  plan.Turn(-360.0);
  plan.Face(kUmbrellaM);
  plan.Stand(2.0);
  plan.Ride({{3.4, 2.3}, {4.3, 2.4}}, 360.0);
  plan.Face(kOtherChairM);
  plan.Stand(4.0);
  plan.Face(kOtherUmbrellaM);
  plan.Stand(3.0);
  plan.Turn(360.0);
  plan.Ride({{3.9, 1.8}, {3.3, 1.5}}, 360.0);
  plan.Face({3.6, 5.0});
  plan.Stand(3.0);
  plan.Face({0.5, 0.8});
  plan.Scan(30.0, 1);
  plan.StandForChange(6.0);  // the bear moves
  plan.Turn(720.0);
  plan.Ride({{3.8, 1.6}, {4.3, 2.3}}, -360.0);
  plan.Face(kOtherChairM);
  plan.Stand(4.0);
  plan.Orbit(kOtherChairM, -30.0, 1.8);
  plan.Stand(3.0);
  plan.Orbit(kOtherChairM, 40.0, 1.9);
  plan.Stand(2.0);
  plan.Turn(360.0);
  plan.Ride({{3.2, 2.2}, {2.3, 2.3}}, 360.0);
  plan.Face(kChairM);
  plan.Stand(4.0);
  plan.Turn(-720.0);
  plan.Ride({{3.0, 1.8}}, 360.0);
  plan.Face({3.3, 5.0});
  plan.Stand(3.0);
  return plan.Finish(kChangingFigures.duration_s);
}

RobotRide ShortRide(std::uint64_t seed) {
  RobotPlan plan({2.4, 2.4}, 95.0,
                 {.speed_mps = 0.45, .turn_dps = 55.0, .ramp_s = 0.5, .place_noise_m = 0.02}, seed);
  plan.Stand(2.5);
  plan.Ride({{3.2, 2.2}}, -35.0);
  plan.Face(kOtherChairM);
  plan.Stand(2.4);
  plan.Ride({{3.4, 1.6}}, -115.0);
  plan.StandForChange(1.5);  // the bear moves
  plan.Ride({{4.0, 2.2}}, 115.0);
  plan.Face(kOtherChairM);
  plan.Stand(2.5);
  plan.Ride({{2.6, 2.3}}, 40.0);
  plan.Face(kChairM);
  plan.Stand(2.5);
  return plan.Finish(kChangingFigures.short_duration_s);
}

}  // namespace

Story MakeChangingStory(const Stage& stage, const StoryOptions& options) {
  const RobotRide ride = options.is_short ? ShortRide(options.seed) : LongRide(options.seed);
  RobotSet set(stage, options, {.palette = 2});
  const int chairs = set.KnownChair();
  const int umbrellas = set.AnyVariant();
  const SetPiece chair = set.Place(PropKind::kChair, chairs, "chair", set.Spot(kChairM));
  const SetPiece other = set.Place(PropKind::kChair, chairs, "other_chair", set.Spot(kOtherChairM));
  set.Place(PropKind::kUmbrella, umbrellas, "umbrella", set.Spot(kUmbrellaM, -90.0));
  set.Place(PropKind::kUmbrella, umbrellas, "other_umbrella", set.Spot(kOtherUmbrellaM, -160.0));
  SetPiece bear = set.PlaceOn(chair, PropKind::kTeddyBear, "teddy_bear");
  set.Move(bear, ride.marks_s.at(0), set.TopOf(other));
  return set.Finish(ride);
}

}  // namespace cslam
