// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/robot_set.h"
#include "cslam/dataset/robot_stories.h"

namespace cslam {
namespace {

const Eigen::Vector2d kChairM(2.4, 4.75);
const Eigen::Vector2d kChairLaterM(4.3, 4.1);
const Eigen::Vector2d kUmbrellaM(4.8, 4.8);
const Eigen::Vector2d kUmbrellaLaterM(1.75, 4.4);
const Eigen::Vector2d kSuitcaseM(3.5, 4.75);
const Eigen::Vector2d kSuitcaseLaterM(2.75, 4.2);
const Eigen::Vector2d kOverviewM(3.3, 1.2);
const Eigen::Vector2d kMiddleM(3.3, 4.6);

RobotRide LongRide(std::uint64_t seed) {
  RobotPlan plan({2.4, 2.6}, 90.0, {.speed_mps = 0.2, .turn_dps = 40.0, .place_noise_m = 0.02},
                 seed);
  plan.Stand(5.0);
  plan.Orbit(kChairM, 30.0, 1.9);
  plan.Stand(4.0);
  plan.Orbit(kChairM, -45.0, 2.0);
  plan.Stand(3.0);
  plan.Turn(360.0);
  plan.Ride({{3.0, 2.8}, {3.5, 3.5}});
  plan.Face(kSuitcaseM);  // near enough to see the mug
  plan.Stand(5.0);
  plan.Ride({{3.6, 2.8}, {4.0, 2.4}}, -360.0);
  plan.Face(kUmbrellaM);
  plan.Stand(4.0);
  plan.Ride({{3.8, 1.6}, kOverviewM}, 360.0);
  plan.Face(kMiddleM);
  plan.Stand(4.0);
  plan.Turn(130.0);
  plan.Scan(30.0, 1);
  plan.StandForChange(8.0);  // umbrella and chair move
  plan.Turn(-360.0);
  plan.Face(kMiddleM);
  plan.Stand(4.0);
  plan.Ride({{2.6, 1.5}, {3.4, 2.0}, {4.2, 2.2}}, 360.0);
  plan.Face(kChairLaterM);
  plan.Stand(4.0);
  plan.Turn(-360.0);
  plan.Ride({{3.4, 2.4}, {2.4, 2.4}}, 360.0);
  plan.Face(kUmbrellaLaterM);
  plan.Stand(4.0);
  plan.Ride({{2.9, 2.9}, {3.4, 3.45}});
  plan.Face(kSuitcaseM);
  plan.Stand(4.0);
  plan.Ride({{4.2, 2.8}, {4.3, 2.0}, {3.6, 1.6}}, 360.0);
  plan.Turn(360.0);
  plan.Ride({{3.0, 1.9}, {2.7, 1.5}, kOverviewM}, 180.0);
  plan.Face({5.6, 0.6});
  plan.Scan(20.0, 2);
  plan.StandForChange(8.0);  // suitcase, monitor and mug move
  plan.Turn(360.0);
  plan.Face(kMiddleM);
  plan.Stand(4.0);
  plan.Ride({{2.8, 2.0}, {2.75, 2.95}});
  plan.Face(kSuitcaseLaterM);
  plan.Stand(5.0);
  plan.Orbit(kSuitcaseLaterM, 40.0, 1.6);
  plan.Stand(4.0);
  plan.Ride({{3.2, 2.4}, {2.6, 1.8}}, -360.0);
  plan.Face(kMiddleM);
  plan.Stand(4.0);
  plan.Turn(360.0);
  plan.Ride({{3.0, 1.5}, {4.2, 1.7}, {4.2, 2.4}, {3.3, 2.4}}, 360.0);
  plan.Face(kMiddleM);
  plan.Stand(4.0);
  return plan.Finish(kShiftFigures.duration_s);
}

RobotRide ShortRide(std::uint64_t seed) {
  RobotPlan plan({2.6, 2.4}, 95.0,
                 {.speed_mps = 0.45, .turn_dps = 57.0, .ramp_s = 0.5, .place_noise_m = 0.02}, seed);
  plan.Stand(2.2);
  plan.Ride({{3.2, 2.6}}, -20.0);
  plan.Face(kSuitcaseM);
  plan.Stand(2.2);
  plan.Ride({{3.7, 2.3}}, -25.0);
  plan.Face(kUmbrellaM);
  plan.Stand(2.2);
  plan.Ride({{3.3, 1.6}}, -100.0);
  plan.StandForChange(1.0);  // umbrella and chair move
  plan.Ride({{3.6, 1.9}}, 95.0);
  plan.Face(kUmbrellaM);
  plan.Stand(2.2);
  plan.Ride({{3.0, 2.3}}, 60.0);
  plan.Face(kUmbrellaLaterM);
  plan.Stand(2.2);
  plan.Ride({{3.0, 1.8}}, 80.0);
  plan.StandForChange(1.0);  // suitcase, monitor and mug move
  plan.Ride({{2.9, 2.4}}, -110.0);
  plan.Face(0.5 * (kSuitcaseM + kSuitcaseLaterM));
  plan.Stand(3.0);
  return plan.Finish(kShiftFigures.short_duration_s);
}

}  // namespace

Story MakeShiftStory(const Stage& stage, const StoryOptions& options) {
  const RobotRide ride = options.is_short ? ShortRide(options.seed) : LongRide(options.seed);
  RobotSet set(stage, options, {.palette = 0});
  SetPiece umbrella =
      set.Place(PropKind::kUmbrella, set.AnyVariant(), "umbrella", set.Spot(kUmbrellaM, -110.0));
  SetPiece chair = set.Place(PropKind::kChair, set.KnownChair(), "chair", set.Spot(kChairM));
  SetPiece bear = set.PlaceOn(chair, PropKind::kTeddyBear, "teddy_bear");
  SetPiece suitcase =
      set.Place(PropKind::kSuitcase, set.AnyVariant(), "suitcase", set.Spot(kSuitcaseM));
  SetPiece monitor =
      set.PlaceOn(suitcase, PropKind::kMonitor, "monitor", Standing(-0.04, 0.04, 0.0));
  SetPiece mug = set.PlaceOn(suitcase, PropKind::kMug, "mug", Standing(0.17, -0.09, 0.0));
  set.Move(umbrella, ride.marks_s.at(0), set.Spot(kUmbrellaLaterM, -70.0));
  set.MoveWith(chair, {&bear}, ride.marks_s.at(0), set.Spot(kChairLaterM, -110.0));
  set.MoveWith(suitcase, {&monitor, &mug}, ride.marks_s.at(1), set.Spot(kSuitcaseLaterM, -80.0));
  return set.Finish(ride);
}

}  // namespace cslam
