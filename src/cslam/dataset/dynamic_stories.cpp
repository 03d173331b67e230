// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/dynamic_stories.h"

#include "cslam/dataset/handheld_motion.h"
#include "cslam/dataset/office_stage.h"
#include "cslam/dataset/people_cast.h"
#include "cslam/dataset/stage_room.h"

#include <functional>
#include <utility>
#include <vector>

namespace cslam {
namespace {

// Two ways through the strip before the desks and around them, 44 s, that never come nearer than
// 0.6 m to each other.
std::vector<FloorPoint> FirstWay() {
  return {{0.0, {4.3, 2.75}}, {1.5, {4.3, 2.75}},  {4.0, {3.25, 2.25}}, {8.0, {3.25, 2.25}},
          {9.3, {4.0, 2.35}}, {12.0, {4.0, 2.35}}, {15.0, {1.5, 2.35}}, {16.5, {1.5, 2.35}},
          {18.5, {3.2, 2.3}}, {22.5, {3.2, 2.3}},  {25.0, {5.6, 2.7}},  {28.5, {5.6, 6.1}},
          {31.0, {3.5, 6.2}}, {32.5, {3.5, 6.2}},  {35.0, {1.35, 6.0}}, {38.2, {1.35, 3.0}},
          {40.0, {2.9, 2.3}}, {42.0, {2.9, 2.3}},  {44.0, {4.3, 2.75}}};
}

std::vector<FloorPoint> SecondWay() {
  return {{0.0, {2.6, 2.5}},  {1.8, {2.6, 2.5}},   {4.0, {2.5, 2.8}},   {6.0, {3.8, 2.85}},
          {8.5, {4.0, 2.9}},  {11.0, {3.1, 2.45}}, {13.0, {3.1, 2.45}}, {15.5, {5.7, 2.6}},
          {17.0, {5.7, 2.6}}, {19.5, {3.95, 2.4}}, {24.0, {3.95, 2.4}}, {26.5, {3.1, 2.3}},
          {31.0, {3.1, 2.3}}, {33.0, {4.1, 2.3}},  {38.0, {4.1, 2.3}},  {41.0, {4.0, 2.4}},
          {44.0, {2.6, 2.5}}};
}

struct Choreography {
  double start_s = 0.0;  // of the ways
  bool is_mirrored = false;
};

constexpr double kSpareS = 1.0;
constexpr double kWalkingXyzMPerS = 0.207;  // mean speeds of the recordings
constexpr double kSittingXyzMPerS = 0.132;

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
  return OfficeWithWalkers(stage, options, {.start_s = 0.0}, [&](const PathKey& home) {
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
      stage, options, {.start_s = 1.0, .is_mirrored = true}, [&](const PathKey& home) {
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
