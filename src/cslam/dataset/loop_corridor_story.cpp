// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/doorway.h"
#include "cslam/dataset/handheld_motion.h"
#include "cslam/dataset/office_stage.h"
#include "cslam/dataset/stage_room.h"
#include "cslam/dataset/stress_stories.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace cslam {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kDoorwayM = 1.15;  // clear width

// Room 0 in the west, room 1 in the east, corridor 2 in the south, corridor 3 in the north.
struct Building {
  Eigen::Vector2d room_m = {5.0, 8.0};
  double corridor_length_m = 7.0;
  double corridor_width_m = 2.2;

  double east_room_x() const { return room_m.x() + corridor_length_m + 2.0 * kWallThicknessM; }
  double south_y() const { return 0.5 * corridor_width_m; }
  double north_y() const { return room_m.y() - south_y(); }
  double west_x() const { return 0.5 * room_m.x(); }
  double east_x() const { return east_room_x() + west_x(); }
};

Building BuildingFor(const StoryOptions& options) {
  if (!options.is_short) return {};
  return {{3.8, 5.0}, 2.4, 1.8};
}

Opening DoorAt(Wall wall, double along_m) {
  return {wall, along_m - 0.5 * kDoorwayM, along_m + 0.5 * kDoorwayM, kDoorwayHeightM};
}

std::array<RoomShell, 4> ShellsOf(const Building& b, SceneBuilder& scene, const PropLibrary& props,
                                  Rng rng) {
  const auto surface = [&](SurfaceKind kind) {
    return props.AddSurface(scene, kind, static_cast<int>(rng.Index(1000)));
  };
  const int ceiling = surface(SurfaceKind::kPlaster);
  const int corridor_floor = surface(SurfaceKind::kTiles);
  const std::array<int, 4> surfaces{surface(SurfaceKind::kWallpaper), surface(SurfaceKind::kBrick),
                                    surface(SurfaceKind::kPlaster), surface(SurfaceKind::kPlaster)};
  const std::array<int, 2> floors{surface(SurfaceKind::kParquet), surface(SurfaceKind::kCarpet)};
  std::array<RoomShell, 4> shells;
  for (std::size_t i = 0; i < shells.size(); ++i) {
    shells[i].walls = {surfaces[i], surfaces[i], surfaces[i], surfaces[i]};
    shells[i].ceiling = ceiling;
    shells[i].floor = i < 2 ? floors[i] : corridor_floor;
    shells[i].size_m = i < 2 ? b.room_m : Eigen::Vector2d(b.corridor_length_m, b.corridor_width_m);
  }
  shells[1].corner_m = {b.east_room_x(), 0.0};
  shells[2].corner_m = {b.room_m.x() + kWallThicknessM, 0.0};
  shells[3].corner_m = {b.room_m.x() + kWallThicknessM, b.room_m.y() - b.corridor_width_m};
  shells[0].openings = {DoorAt(Wall::kEast, b.south_y()),
                        DoorAt(Wall::kEast, b.room_m.y() - b.south_y())};
  shells[1].openings = {DoorAt(Wall::kWest, b.south_y()),
                        DoorAt(Wall::kWest, b.room_m.y() - b.south_y())};
  for (std::size_t i = 2; i < 4; ++i) {
    shells[i].openings = {DoorAt(Wall::kWest, b.south_y()), DoorAt(Wall::kEast, b.south_y())};
  }
  return shells;
}

void AddDoorways(const Building& b, SceneBuilder& scene, const PropLibrary& props) {
  const int wood = props.AddSurface(scene, SurfaceKind::kWood, 3);
  for (const double x :
       {b.room_m.x() + 0.5 * kWallThicknessM, b.east_room_x() - 0.5 * kWallThicknessM}) {
    for (const double y : {b.south_y(), b.north_y()})
      AddDoorway(scene, {x, y}, kDoorwayM, true, wood);
  }
}

// Furniture along a wall from end to end, pictures above what is low; `first` shifts the kinds.
void FillWall(RoomDecorator& room, Wall wall, int first) {
  constexpr std::array kKinds{PropKind::kBookcase, PropKind::kCabinet,     PropKind::kDesk,
                              PropKind::kCarton,   PropKind::kPottedPlant, PropKind::kCabinet};
  constexpr double kPitchM = 1.35;
  const double length_m = LengthOf(room.room(), wall);
  const int count = std::max(1, static_cast<int>(length_m / kPitchM));
  for (int i = 0; i < count; ++i) {
    const double along_m = length_m * (i + 0.5) / count;
    const PropKind kind = kKinds[static_cast<std::size_t>(first + i) % kKinds.size()];
    const Se3 T_world_top = room.AgainstWall(kind, wall, along_m);
    if (kind == PropKind::kBookcase) continue;
    if (kind == PropKind::kCabinet) room.Put(PropKind::kBooks, T_world_top);
    if (kind == PropKind::kDesk) room.Put(PropKind::kMonitor, T_world_top);
    room.Hang(wall, along_m, 1.25, 0.75);
  }
}

void Furnish(const Building& b, RoomDecorator& room, std::size_t number) {
  const int first = static_cast<int>(number) * 2;
  if (number < 2) {
    const Wall far_wall = number == 0 ? Wall::kWest : Wall::kEast;
    const Wall door_wall = number == 0 ? Wall::kEast : Wall::kWest;
    FillWall(room, far_wall, first);
    for (const Wall wall : {Wall::kNorth, Wall::kSouth}) {
      const double length_m = LengthOf(room.room(), wall);
      room.AgainstWall(PropKind::kBookcase, wall, 0.22 * length_m);
      room.Hang(wall, 0.48 * length_m, 0.8, 0.9);
      room.Hang(wall, 0.75 * length_m, 1.1, 0.8);
      room.AgainstWall(PropKind::kSuitcase, wall, 0.62 * length_m, 0.2);
      room.AgainstWall(PropKind::kCarton, wall, 0.85 * length_m, 0.2);
    }
    const double middle_m = 0.5 * b.room_m.y();
    room.AgainstWall(PropKind::kBookcase, door_wall, middle_m - 0.5);
    room.Hang(door_wall, middle_m + 0.5, 1.0, 0.8);
    room.AgainstWall(PropKind::kChair, door_wall, middle_m + 0.5);
    return;
  }
  const double step_m = 1.5;
  int i = first;
  for (double along_m = 0.7; along_m < b.corridor_length_m - 0.4; along_m += step_m, ++i) {
    room.Hang(Wall::kNorth, along_m, 0.95 + 0.1 * (i % 3), 0.7 + 0.1 * (i % 2));
    room.Hang(Wall::kSouth, along_m + 0.3, 1.0 + 0.1 * (i % 2), 0.8);
  }
  room.AgainstWall(PropKind::kCarton, Wall::kNorth, 0.35 * b.corridor_length_m, 0.15);
  room.AgainstWall(PropKind::kPottedPlant, Wall::kSouth, 0.75 * b.corridor_length_m);
}

// Once around through all rooms and on over the first stretch, the gaze ahead.
CameraMotion Round(const Building& b, const StoryOptions& options) {
  constexpr double kHandHeightM = 1.25;
  constexpr double kPitchRad = -7.0 * kDegree;
  constexpr double kTurnM = 0.7;  // the turn begins this far before a corner
  const std::array<Eigen::Vector2d, 4> corners{{{b.west_x(), b.south_y()},
                                                {b.east_x(), b.south_y()},
                                                {b.east_x(), b.north_y()},
                                                {b.west_x(), b.north_y()}}};
  std::vector<TimedView> views;
  double way_m = 0.0;  // stands for the time at first
  const auto add = [&](const Eigen::Vector2d& p, double yaw_deg) {
    if (!views.empty()) way_m += (p - views.back().view.position.head<2>()).norm();
    views.push_back({way_m, {{p.x(), p.y(), kHandHeightM}, yaw_deg * kDegree, kPitchRad}, 0.0});
  };
  add(corners[0], 0.0);
  for (std::size_t side = 0; side < 4; ++side) {
    const Eigen::Vector2d& to = corners[(side + 1) % 4];
    const Eigen::Vector2d ahead = (to - corners[side]).normalized();
    const double yaw_deg = 90.0 * static_cast<double>(side);
    const double length_m = (to - corners[side]).norm();
    // A glance to both sides on the way.
    add(corners[side] + 0.35 * length_m * ahead, yaw_deg + 18.0);
    add(corners[side] + 0.65 * length_m * ahead, yaw_deg - 15.0);
    add(to - kTurnM * ahead, yaw_deg);
    const Eigen::Vector2d onward(-ahead.y(), ahead.x());
    add(to + kTurnM * onward, yaw_deg + 90.0);
  }
  add(corners[0] + 0.35 * (corners[1] - corners[0]), 378.0);
  add(corners[0] + 0.65 * (corners[1] - corners[0]), 345.0);
  const double whole_s = options.is_short ? kShortLoopCorridorS : kLoopCorridorS;
  for (TimedView& view : views)
    view.time_s *= whole_s / way_m;
  HandTremor tremor;
  tremor.seed = options.seed;
  return HandheldMotion(std::move(views), 0.8, tremor);
}

}  // namespace

Story MakeLoopCorridor(const Stage& stage, const StoryOptions& options) {
  const Building building = BuildingFor(options);
  SceneBuilder scene(options.seed, kStoryLightCellM);
  const std::array<RoomShell, 4> shells =
      ShellsOf(building, scene, stage.props, Rng(options.seed, 0, 61));
  AddShells(scene, shells);
  AddDoorways(building, scene, stage.props);
  for (std::size_t i = 0; i < shells.size(); ++i) {
    RoomDecorator room(stage.props, scene, shells[i], options.seed * 8 + i);
    Furnish(building, room, i);
  }
  Story story;
  story.world.scene = scene.Take(RoomLighting(shells));
  story.camera = Round(building, options);
  return story;
}

}  // namespace cslam
