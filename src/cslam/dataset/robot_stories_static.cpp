// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/robot_set.h"
#include "cslam/dataset/robot_stories.h"

namespace cslam {
namespace {

const Eigen::Vector2d kChairM(2.3, 4.6);
const Eigen::Vector2d kUmbrellaM(4.7, 4.6);
const Eigen::Vector2d kSuitcaseM(5.8, 3.7);
const Eigen::Vector2d kPlantM(1.3, 1.4);

RobotRide LongRide(std::uint64_t seed) {
  RobotPlan plan({2.3, 2.4}, 90.0, {.speed_mps = 0.25, .turn_dps = 50.0, .place_noise_m = 0.02},
                 seed);
  plan.Stand(3.0);
  plan.Orbit(kChairM, 35.0, 1.8);
  plan.Stand(2.0);
  plan.Orbit(kChairM, -60.0, 1.9);
  plan.Stand(1.0);
  plan.Turn(-360.0);
  plan.Face(kUmbrellaM);
  plan.Ride({{3.9, 2.7}}, 360.0);
  plan.Stand(2.0);
  plan.Face(kSuitcaseM);
  plan.Ride({{4.3, 2.4}});
  plan.Stand(2.0);
  plan.Turn(-360.0);
  plan.Ride({{4.0, 1.8}, {3.2, 1.6}}, -360.0);
  plan.Face(kPlantM);
  plan.Stand(2.0);
  plan.Turn(720.0);
  plan.Ride({{2.7, 1.8}, {2.3, 2.4}}, 360.0);
  plan.Face(kChairM);
  plan.Stand(3.0);
  return plan.Finish(kStaticFigures.duration_s);
}

RobotRide ShortRide(std::uint64_t seed) {
  RobotPlan plan({2.3, 2.4}, 90.0,
                 {.speed_mps = 0.4, .turn_dps = 50.0, .ramp_s = 0.6, .place_noise_m = 0.02}, seed);
  plan.Stand(2.0);
  plan.Orbit(kChairM, -30.0, 1.9);
  plan.Face(kUmbrellaM);
  plan.Stand(1.5);
  plan.Face(kSuitcaseM);
  plan.Ride({{4.0, 2.4}});
  plan.Stand(1.5);
  plan.Ride({{3.4, 2.0}}, -130.0);
  plan.Face(kPlantM);
  plan.Stand(1.5);
  plan.Ride({{2.3, 2.4}}, -120.0);
  plan.Face(kChairM);
  plan.Stand(2.0);
  return plan.Finish(kStaticFigures.short_duration_s);
}

}  // namespace

Story MakeStaticStory(const Stage& stage, const StoryOptions& options) {
  RobotSet set(stage, options, {});
  const SetPiece chair = set.Place(PropKind::kChair, set.KnownChair(), "chair", set.Spot(kChairM));
  set.PlaceOn(chair, PropKind::kTeddyBear, "teddy_bear");
  set.Place(PropKind::kUmbrella, set.AnyVariant(), "umbrella", set.Spot(kUmbrellaM, -105.0));
  set.Place(PropKind::kSuitcase, set.AnyVariant(), "suitcase", set.Spot(kSuitcaseM, 180.0));
  set.Place(PropKind::kPottedPlant, set.AnyVariant(), "potted_plant", set.Spot(kPlantM, 30.0));
  return set.Finish(options.is_short ? ShortRide(options.seed) : LongRide(options.seed));
}

}  // namespace cslam
