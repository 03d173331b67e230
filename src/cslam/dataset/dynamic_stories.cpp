// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/dynamic_stories.h"

#include "cslam/dataset/handheld_motion.h"
#include "cslam/dataset/office_stage.h"
#include "cslam/dataset/people_cast.h"
#include "cslam/dataset/stage_room.h"

#include <functional>
#include <numbers>
#include <utility>
#include <vector>

namespace cslam {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

FloorPoint Pass(double time_s, double x, double y) {
  return {time_s, {x, y}};
}

// A halt, turned to a direction: -90 degrees is to the camera, 90 to the desks.
FloorPoint Halt(double time_s, double x, double y, double facing_deg) {
  return {time_s, {x, y}, facing_deg * kDegree};
}

// Two ways through the strip before the desks and to their sides, 40 s, then again from the start.
std::vector<FloorPoint> FirstWay() {
  return {
      Halt(0.0, 4.2, 2.7, -110.0),    Halt(2.0, 4.2, 2.7, -110.0),  Halt(4.4, 3.1, 2.3, 80.0),
      Halt(8.0, 3.1, 2.3, 80.0),      Halt(9.5, 4.1, 2.3, -95.0),   Halt(12.2, 4.1, 2.3, -95.0),
      Pass(14.2, 5.6, 2.5),           Halt(15.0, 5.6, 2.5, 170.0),  Halt(17.0, 3.85, 2.35, -105.0),
      Halt(22.0, 3.85, 2.35, -105.0), Pass(24.0, 5.55, 2.7),        Halt(26.8, 5.6, 4.9, 180.0),
      Halt(28.3, 5.6, 4.9, 180.0),    Pass(31.0, 5.55, 2.7),        Halt(32.6, 4.0, 2.5, 75.0),
      Halt(36.0, 4.0, 2.5, 75.0),     Halt(37.0, 4.2, 2.7, -110.0), Halt(40.0, 4.2, 2.7, -110.0)};
}

std::vector<FloorPoint> SecondWay() {
  return {
      Halt(0.0, 2.9, 2.35, 100.0),   Halt(1.5, 2.9, 2.35, 100.0),   Pass(3.2, 2.6, 3.0),
      Halt(5.4, 3.75, 3.0, -90.0),   Halt(9.5, 3.75, 3.0, -90.0),   Halt(11.5, 3.0, 2.45, 85.0),
      Halt(12.8, 3.0, 2.45, 85.0),   Pass(15.0, 1.3, 2.5),          Halt(15.4, 1.3, 2.5, 10.0),
      Halt(17.5, 3.15, 2.45, -75.0), Halt(21.5, 3.15, 2.45, -75.0), Halt(23.5, 3.55, 2.35, 90.0),
      Halt(27.0, 3.55, 2.35, 90.0),  Halt(28.4, 3.15, 2.35, -85.0), Halt(36.0, 3.1, 2.35, -85.0),
      Halt(37.0, 2.9, 2.35, 100.0),  Halt(40.0, 2.9, 2.35, 100.0)};
}

struct Choreography {
  double start_s = 0.0;  // of the ways
  bool is_mirrored = false;
};

constexpr double kSpareS = 1.0;
constexpr double kWalkingXyzMPerS = 0.207;  // mean speeds of the recordings
constexpr double kSittingXyzMPerS = 0.132;
constexpr double kHalfsphereBackM = 0.1;  // this camera leans far forward

double DurationOf(const StoryOptions& options, double whole_s) {
  return options.is_short ? kShortDynamicS : whole_s;
}

using MotionMaker = std::function<CameraMotion(const PathKey& home)>;

Story OfficeWithWalkers(const Stage& stage, const StoryOptions& options,
                        const Choreography& choreography, const MotionMaker& make_motion) {
  SceneBuilder scene(options.seed, kStoryLightCellM);
  const Office office = AddOffice(scene, stage.props, {.seed = options.seed});
  Story story;
  story.camera = make_motion(office.home);
  PeopleCast cast(scene, stage.assets, options.seed);
  int number = 0;
  for (const std::vector<FloorPoint>& way : {FirstWay(), SecondWay()}) {
    // A little longer, so that nobody stops or vanishes in the last frame.
    std::vector<FloorPoint> points = CutCycle(
        way, choreography.start_s, choreography.start_s + story.camera.duration_s + kSpareS);
    if (choreography.is_mirrored) points = Mirrored(std::move(points), kOfficeMiddleXM);
    cast.Add(number++ == 0 ? "first_person" : "second_person",
             Walk(std::move(points), cast.MotionSeed()));
  }
  story.world.scene = scene.Take(RoomLighting({&office.room, 1}));
  story.world.animations = cast.Take();
  story.people = {.min_mean_share = 0.25, .min_peak_share = 0.5, .leave_view = true};
  return story;
}

}  // namespace

Story MakeWalkingStatic(const Stage& stage, const StoryOptions& options) {
  return OfficeWithWalkers(stage, options, {.start_s = 5.0}, [&](const PathKey& home) {
    return StaticHand(home, DurationOf(options, kWalkingStaticS), options.seed);
  });
}

Story MakeWalkingXyz(const Stage& stage, const StoryOptions& options) {
  return OfficeWithWalkers(
      stage, options, {.start_s = 9.0, .is_mirrored = true}, [&](const PathKey& home) {
        return XyzHand(home, DurationOf(options, kWalkingXyzS), kWalkingXyzMPerS, options.seed);
      });
}

Story MakeWalkingRpy(const Stage& stage, const StoryOptions& options) {
  return OfficeWithWalkers(stage, options, {.start_s = 7.0}, [&](const PathKey& home) {
    return RpyHand(home, DurationOf(options, kWalkingRpyS), options.seed);
  });
}

Story MakeWalkingHalfsphere(const Stage& stage, const StoryOptions& options) {
  return OfficeWithWalkers(
      stage, options, {.start_s = 1.0, .is_mirrored = true}, [&](PathKey home) {
        home.position.y() -= kHalfsphereBackM;
        return HalfsphereHand(home, DurationOf(options, kWalkingHalfsphereS), options.seed);
      });
}

Story MakeSittingXyz(const Stage& stage, const StoryOptions& options) {
  SceneBuilder scene(options.seed, kStoryLightCellM);
  const Office office =
      AddOffice(scene, stage.props, {.seed = options.seed, .chairs_in_front = true});
  PeopleCast cast(scene, stage.assets, options.seed);
  for (const OfficeSeat& seat : office.seats) {
    Sitting sitting;
    sitting.T_world_seat = seat.T_world_chair;
    sitting.seat_height_m = seat.seat_height_m;
    cast.Add("sitting_person", Sit(sitting, cast.MotionSeed()));
  }
  Story story;
  story.world.scene = scene.Take(RoomLighting({&office.room, 1}));
  story.world.animations = cast.Take();
  story.camera =
      XyzHand(office.home, DurationOf(options, kSittingXyzS), kSittingXyzMPerS, options.seed);
  story.people = {.min_mean_share = 0.15, .min_peak_share = 0.2, .leave_view = false};
  return story;
}

}  // namespace cslam
