// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/stress_stories.h"

#include "cslam/dataset/handheld_motion.h"
#include "cslam/dataset/office_stage.h"
#include "cslam/dataset/room_tour.h"
#include "cslam/dataset/stage_room.h"

#include <numbers>
#include <utility>
#include <vector>

namespace cslam {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kHandHeightM = 1.2;
constexpr double kRingRoundingS = 0.5;

Scene LabScene(const Stage& stage, const LabOptions& options, const Eigen::Vector2d& table_m) {
  SceneBuilder scene(options.seed, kStoryLightCellM);
  const RoomShell room = AddLab(scene, stage.props, options);
  PropPlacer put(scene, stage.props, options.seed);
  const Se3 T_world_top =
      put.Put(PropKind::kTable, Standing(table_m.x(), table_m.y(), 0.0, 0.2)).T_world_top;
  put.Put(PropKind::kBooks, T_world_top * Standing(-0.5, 0.1, 0.0, 0.3));
  put.Put(PropKind::kMug, T_world_top * Standing(0.1, -0.2, 0.0, 1.0));
  put.Put(PropKind::kPottedPlant, T_world_top * Standing(0.45, 0.1, 0.0));
  return scene.Take(RoomLighting({&room, 1}));
}

CameraMotion Ring(const RingWalk& ring, double duration_s, std::uint64_t seed) {
  HandTremor tremor;
  tremor.seed = seed;
  return HandheldMotion(RingViews(ring, 0.0, duration_s), kRingRoundingS, tremor);
}

RingWalk LabRing() {
  RingWalk ring;
  ring.center_m = {3.5, 3.0};
  ring.radius_m = 1.25;
  ring.height_m = kHandHeightM;
  return ring;
}

Story LabStory(const Stage& stage, const StoryOptions& options) {
  Story story;
  const LabOptions lab{.seed = options.seed, .size_m = {7.0, 6.0}, .palette = 1};
  story.world.scene = LabScene(stage, lab, {3.5, 3.0});
  return story;
}

}  // namespace

Story MakeKidnapped(const Stage& stage, const StoryOptions& options) {
  constexpr double kCoverS = 0.4;          // the hand comes and goes
  constexpr double kCoveredS = 0.8;        // on each side of the jump
  constexpr double kCoveredLight = 0.004;  // what passes between the fingers
  const double whole_s = options.is_short ? kShortKidnappedS : kKidnappedS;
  const double tour_s = 0.5 * whole_s;
  const double visit_s = 0.25 * whole_s;
  Story story = LabStory(stage, options);
  RingWalk tour = LabRing();
  RingWalk first = LabRing();
  first.from_deg = 200.0;
  first.to_deg = 290.0;
  first.radius_m = 1.35;
  RingWalk second = LabRing();
  second.from_deg = 20.0;
  second.to_deg = 110.0;
  second.radius_m = 1.15;
  story.camera =
      OneAfterTheOther({Ring(tour, tour_s, options.seed), Ring(first, visit_s, options.seed + 1),
                        Ring(second, visit_s, options.seed + 2)});
  const double jump_s = tour_s + visit_s;
  story.exposure = PiecewiseLinear({{jump_s - kCoveredS - kCoverS, 1.0},
                                    {jump_s - kCoveredS, kCoveredLight},
                                    {jump_s + kCoveredS, kCoveredLight},
                                    {jump_s + kCoveredS + kCoverS, 1.0}});
  return story;
}

Story MakeDark(const Stage& stage, const StoryOptions& options) {
  constexpr double kDark = 0.08;
  constexpr double kSwitchS = 0.001;  // between two frames
  const double whole_s = options.is_short ? kShortDarkS : kDarkS;
  Story story = LabStory(stage, options);
  RingWalk ring = LabRing();
  ring.to_deg = 450.0;
  story.camera = Ring(ring, whole_s, options.seed);
  story.exposure = PiecewiseLinear({{0.20 * whole_s, 1.0},
                                    {0.30 * whole_s, kDark},
                                    {0.42 * whole_s, kDark},
                                    {0.52 * whole_s, 1.0},
                                    {0.66 * whole_s, 1.0},
                                    {0.66 * whole_s + kSwitchS, kDark},
                                    {0.80 * whole_s, kDark},
                                    {0.80 * whole_s + kSwitchS, 1.0}});
  return story;
}

Story MakePlainWall(const Stage& stage, const StoryOptions& options) {
  constexpr double kLengthM = 8.0;
  constexpr double kDepthM = 6.0;
  constexpr double kPitchRad = -14.0 * kDegree;
  const double whole_s = options.is_short ? kShortPlainWallS : kPlainWallS;
  SceneBuilder scene(options.seed, kStoryLightCellM);
  LabOptions lab{.seed = options.seed, .size_m = {kLengthM, kDepthM}, .palette = 0};
  lab.plain_north = true;
  const RoomShell room = AddLab(scene, stage.props, lab);
  PropPlacer put(scene, stage.props, options.seed);
  // All there is before the wall.
  put.Put(PropKind::kCarton, AtWall(room, Wall::kNorth, 2.9, 0.3, 0.0, 0.2));
  put.Put(PropKind::kSuitcase, AtWall(room, Wall::kNorth, 5.2, 0.25, 0.0, -0.1));
  const auto view = [&](double share, double x, double out_m, double yaw_deg) {
    return TimedView{
        share * whole_s, {{x, kDepthM - out_m, kHandHeightM}, yaw_deg * kDegree, kPitchRad}, 0.0};
  };
  std::vector<TimedView> views;
  if (options.is_short) {
    views = {view(0.00, 1.7, 1.9, 165.0), view(0.08, 1.6, 1.8, 160.0), view(0.22, 1.7, 1.6, 92.0),
             view(0.80, 6.3, 1.6, 88.0),  view(0.94, 6.4, 1.8, 18.0),  view(1.00, 6.3, 1.9, 15.0)};
  } else {
    views = {view(0.00, 1.7, 1.9, 165.0), view(0.04, 1.6, 1.8, 160.0), view(0.11, 1.7, 1.6, 92.0),
             view(0.42, 6.3, 1.6, 88.0),  view(0.49, 6.4, 1.8, 18.0),  view(0.55, 6.3, 1.7, 20.0),
             view(0.62, 6.2, 1.4, 90.0),  view(0.90, 1.8, 1.4, 91.0),  view(0.97, 1.7, 1.8, 160.0),
             view(1.00, 1.7, 1.9, 165.0)};
  }
  HandTremor tremor;
  tremor.seed = options.seed;
  Story story;
  story.world.scene = scene.Take(RoomLighting({&room, 1}));
  story.camera = HandheldMotion(std::move(views), 0.8, tremor);
  return story;
}

}  // namespace cslam
