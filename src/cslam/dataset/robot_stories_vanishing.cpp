// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/robot_set.h"
#include "cslam/dataset/robot_stories.h"

namespace cslam {
namespace {

const Eigen::Vector2d kChairM(2.6, 4.7);
const Eigen::Vector2d kChairLaterM(4.0, 4.4);
const Eigen::Vector2d kUmbrellaM(4.55, 4.8);
const Eigen::Vector2d kUmbrellaLaterM(2.15, 4.4);
const Eigen::Vector2d kSuitcaseM(3.35, 4.8);
// From here all of it is in the picture.
const Eigen::Vector2d kOverviewM(3.35, 1.2);
const Eigen::Vector2d kMiddleM(3.35, 4.6);

// Which pause belongs to which change.
struct Times {
  double chair_moves_s, umbrella_moves_s, bear_goes_s, suitcase_goes_s, umbrella_goes_s,
      chair_goes_s;
};
struct TimedRide {
  RobotRide ride;
  Times times;
};

TimedRide LongRide(std::uint64_t seed) {
  RobotPlan plan({2.6, 2.5}, 90.0, {.speed_mps = 0.27, .turn_dps = 45.0, .place_noise_m = 0.02},
                 seed);
  plan.Stand(4.0);
  plan.Orbit(kChairM, 30.0, 1.9);
  plan.Stand(3.0);
  plan.Face(kUmbrellaM);
  plan.Stand(3.0);
  plan.Ride({{3.4, 2.4}, kOverviewM}, 360.0);
  plan.Face(kMiddleM);
  plan.Stand(3.0);
  plan.Turn(120.0);
  plan.StandForChange(3.0);  // the chair moves
  plan.Turn(360.0);
  plan.Turn(-120.0);
  plan.Stand(3.0);
  plan.Ride({{3.9, 2.0}, {4.2, 2.6}}, 360.0);
  plan.Face(kChairLaterM);
  plan.Stand(3.0);
  plan.Turn(-360.0);
  plan.Ride({{3.8, 1.8}, {2.4, 1.6}}, -210.0);
  plan.StandForChange(3.0);  // the umbrella moves
  plan.Turn(-360.0);
  plan.Face(kUmbrellaLaterM);
  plan.Stand(3.0);
  plan.Ride({{2.2, 2.1}, {3.0, 2.3}, kOverviewM}, 360.0);
  plan.Face(kMiddleM);
  plan.Stand(4.0);
  plan.Turn(-110.0);
  plan.StandForChange(3.0);  // the bear goes
  plan.Turn(-360.0);
  plan.Face(kMiddleM);
  plan.Stand(3.0);
  plan.Ride({{4.4, 1.6}, {4.4, 2.6}}, 360.0);
  plan.Face(kChairLaterM);
  plan.Stand(2.0);
  plan.Ride({{3.6, 2.2}, {3.0, 1.4}}, 240.0);
  plan.Face({1.0, 0.8});
  plan.StandForChange(3.0);  // the suitcase goes
  plan.Turn(360.0);
  plan.Face(kMiddleM);
  plan.Stand(3.0);
  plan.Ride({{2.4, 2.2}, {3.2, 2.6}, {4.4, 2.4}, kOverviewM}, -360.0);
  plan.Face(kMiddleM);
  plan.Stand(3.0);
  plan.Turn(120.0);
  plan.StandForChange(3.0);  // umbrella and chair go
  plan.Turn(-360.0);
  plan.Face(kMiddleM);
  plan.Stand(4.0);
  plan.Ride({{2.6, 1.6}, {2.4, 2.8}}, 360.0);
  plan.Ride({{3.0, 3.0}, {4.2, 2.8}}, -360.0);
  plan.Face(kMiddleM);
  plan.Stand(3.0);
  const RobotRide ride = plan.Finish(kVanishingFigures.duration_s);
  const std::vector<double>& m = ride.marks_s;
  return {ride, {m.at(0), m.at(1), m.at(2), m.at(3), m.at(4), m.at(4)}};
}

TimedRide ShortRide(std::uint64_t seed) {
  RobotPlan plan({2.7, 2.0}, 90.0,
                 {.speed_mps = 0.45, .turn_dps = 57.0, .ramp_s = 0.5, .place_noise_m = 0.02}, seed);
  plan.Stand(2.2);
  plan.Ride({kOverviewM});
  plan.Stand(2.2);
  plan.Ride({{4.2, 1.6}}, 100.0);
  plan.StandForChange(1.0);  // chair and umbrella move
  plan.Ride({{3.5, 1.15}}, -100.0);
  plan.Stand(2.5);
  plan.Ride({{2.6, 1.7}}, -105.0);
  plan.StandForChange(1.0);  // bear and suitcase go
  plan.Ride({{3.2, 1.15}}, 105.0);
  plan.Stand(2.5);
  plan.Ride({{4.2, 1.5}}, 100.0);
  plan.StandForChange(1.0);  // the rest goes
  plan.Ride({kOverviewM}, -100.0);
  plan.Stand(3.0);
  const RobotRide ride = plan.Finish(kVanishingFigures.short_duration_s);
  const std::vector<double>& m = ride.marks_s;
  return {ride, {m.at(0), m.at(0), m.at(1), m.at(1), m.at(2), m.at(2)}};
}

}  // namespace

Story MakeVanishingStory(const Stage& stage, const StoryOptions& options) {
  const auto [ride, times] = options.is_short ? ShortRide(options.seed) : LongRide(options.seed);
  RobotSet set(stage, options, {.palette = 1});
  SetPiece chair = set.Place(PropKind::kChair, set.KnownChair(), "chair", set.Spot(kChairM));
  SetPiece bear = set.PlaceOn(chair, PropKind::kTeddyBear, "teddy_bear");
  SetPiece umbrella =
      set.Place(PropKind::kUmbrella, set.AnyVariant(), "umbrella", set.Spot(kUmbrellaM, -105.0));
  const SetPiece suitcase =
      set.Place(PropKind::kSuitcase, set.AnyVariant(), "suitcase", set.Spot(kSuitcaseM));
  set.MoveWith(chair, {&bear}, times.chair_moves_s, set.Spot(kChairLaterM));
  set.Move(umbrella, times.umbrella_moves_s, set.Spot(kUmbrellaLaterM, -75.0));
  set.Remove(bear, times.bear_goes_s);
  set.Remove(suitcase, times.suitcase_goes_s);
  set.Remove(umbrella, times.umbrella_goes_s);
  set.Remove(chair, times.chair_goes_s);
  return set.Finish(ride);
}

}  // namespace cslam
