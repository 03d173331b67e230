// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/robot_set.h"
#include "cslam/dataset/robot_stories.h"

namespace cslam {
namespace {

const Eigen::Vector2d kBearChairM(2.3, 4.6);
const Eigen::Vector2d kBookChairM(4.7, 4.6);
const Eigen::Vector2d kSuitcaseM(3.5, 4.75);
const Eigen::Vector2d kOverviewM(3.45, 1.4);
const Eigen::Vector2d kMiddleM(3.5, 4.6);

// Full turns wherever it goes: this is the sequence with the fastest turning.
RobotRide LongRide(std::uint64_t seed) {
  RobotPlan plan({2.3, 2.5}, 90.0,
                 {.speed_mps = 0.35, .turn_dps = 66.0, .ramp_s = 0.6, .place_noise_m = 0.02}, seed);
  plan.Stand(3.0);
  plan.Orbit(kBearChairM, 30.0, 1.9);
  plan.Stand(2.0);
  plan.Orbit(kBearChairM, -40.0, 2.0);
  plan.Turn(-360.0);
  plan.RideAndFace({{3.0, 2.8}, {3.5, 3.3}}, kSuitcaseM, -1);
  plan.Stand(3.0);
  plan.RideAndFace({{3.8, 2.6}, {4.5, 2.5}}, kBookChairM, 2);
  plan.Stand(3.0);
  plan.Turn(360.0);
  plan.RideAndFace({{4.2, 1.8}, kOverviewM}, kMiddleM, 1);
  plan.Stand(2.0);
  plan.Turn(480.0);
  plan.StandForChange(3.0);  // the chair with the bear becomes an umbrella
  plan.RideAndFace({{3.3, 1.6}}, kMiddleM, -1);
  plan.Stand(2.0);
  plan.RideAndFace({{2.6, 2.3}}, kBearChairM, -1);
  plan.Stand(3.0);
  plan.Turn(-360.0);
  plan.RideAndFace({{3.2, 2.2}, {4.4, 2.4}}, kBookChairM, 1);
  plan.Stand(3.0);
  plan.Turn(360.0);
  plan.RideAndFace({{3.4, 1.8}}, {0.6, 0.9}, 2);
  plan.StandForChange(3.0);  // the other chair goes
  plan.Turn(720.0);
  plan.RideAndFace({{3.4, 2.0}, {4.2, 2.3}}, kBookChairM, 2);
  plan.Stand(3.0);
  plan.RideAndFace({{3.2, 2.2}, {2.4, 2.4}}, kBearChairM, -2);
  plan.Stand(2.0);
  plan.Turn(360.0);
  plan.RideAndFace({kOverviewM}, kMiddleM, 1);
  plan.Stand(3.0);
  return plan.Finish(kReplacingFigures.duration_s);
}

RobotRide ShortRide(std::uint64_t seed) {
  RobotPlan plan({2.5, 2.3}, 95.0,
                 {.speed_mps = 0.45, .turn_dps = 57.0, .ramp_s = 0.5, .place_noise_m = 0.02}, seed);
  plan.Stand(2.2);
  plan.Ride({{3.3, 2.6}}, -20.0);
  plan.Face(kSuitcaseM);
  plan.Stand(2.0);
  plan.Ride({{4.0, 2.3}}, -20.0);
  plan.Face(kBookChairM);
  plan.Stand(2.2);
  plan.Ride({{3.3, 1.7}}, -115.0);
  plan.StandForChange(1.0);  // the chair with the bear becomes an umbrella
  plan.Ride({{3.2, 2.1}}, 150.0);
  plan.Face(kBearChairM);
  plan.Stand(2.5);
  plan.Ride({{3.8, 1.7}}, 100.0);
  plan.StandForChange(1.0);  // the other chair goes
  plan.Ride({{4.2, 2.3}}, -145.0);
  plan.Face(kBookChairM);
  plan.Stand(2.5);
  plan.Turn(30.0);
  plan.Stand(1.5);
  return plan.Finish(kReplacingFigures.short_duration_s);
}

}  // namespace

Story MakeReplacingStory(const Stage& stage, const StoryOptions& options) {
  const RobotRide ride = options.is_short ? ShortRide(options.seed) : LongRide(options.seed);
  RobotSet set(stage, options, {.palette = 1});
  const SetPiece book_chair =
      set.Place(PropKind::kChair, set.KnownChair(), "chair", set.Spot(kBookChairM));
  const SetPiece books = set.PlaceOn(book_chair, PropKind::kBooks, "books");
  const Se3 T_world_spot = set.Spot(kBearChairM);
  const SetPiece bear_chair =
      set.Place(PropKind::kChair, set.KnownChair(), "other_chair", T_world_spot);
  const SetPiece bear = set.PlaceOn(bear_chair, PropKind::kTeddyBear, "teddy_bear");
  const SetPiece suitcase =
      set.Place(PropKind::kSuitcase, set.AnyVariant(), "suitcase", set.Spot(kSuitcaseM));
  set.PlaceOn(suitcase, PropKind::kMonitor, "monitor", Standing(-0.04, 0.04, 0.0));
  set.PlaceOn(suitcase, PropKind::kMug, "mug", Standing(0.17, -0.09, 0.0));
  const SetPiece umbrella =
      set.Place(PropKind::kUmbrella, set.AnyVariant(), "umbrella", T_world_spot);
  set.Remove(bear_chair, ride.marks_s.at(0));
  set.Remove(bear, ride.marks_s.at(0));
  set.ComeLater(umbrella, ride.marks_s.at(0));
  set.Remove(book_chair, ride.marks_s.at(1));
  set.Remove(books, ride.marks_s.at(1));
  return set.Finish(ride);
}

}  // namespace cslam
