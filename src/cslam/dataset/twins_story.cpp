// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/doorway.h"
#include "cslam/dataset/handheld_motion.h"
#include "cslam/dataset/office_stage.h"
#include "cslam/dataset/room_tour.h"
#include "cslam/dataset/stage_room.h"
#include "cslam/dataset/stress_stories.h"
#include "cslam/util/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace cslam {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kRoomM = 4.6;           // both rooms are square
constexpr double kTwinShiftM = 5.2;      // from one room to the other, along x
constexpr double kCorridorWidthM = 2.0;  // south of both
constexpr double kDoorwayM = 1.15;
constexpr double kDoorXM = 0.5 * kRoomM;
constexpr double kCorridorYM = -kWallThicknessM - 0.5 * kCorridorWidthM;

RoomShell FirstRoom(SceneBuilder& scene, const PropLibrary& props, Rng& rng) {
  const auto surface = [&](SurfaceKind kind) {
    return props.AddSurface(scene, kind, static_cast<int>(rng.Index(1000)));
  };
  RoomShell room;
  room.size_m = {kRoomM, kRoomM};
  room.walls = {surface(SurfaceKind::kWallpaper), surface(SurfaceKind::kBrick),
                surface(SurfaceKind::kPlaster), surface(SurfaceKind::kPlaster)};
  room.floor = surface(SurfaceKind::kParquet);
  room.ceiling = surface(SurfaceKind::kPlaster);
  room.openings = {
      {Wall::kSouth, kDoorXM - 0.5 * kDoorwayM, kDoorXM + 0.5 * kDoorwayM, kDoorwayHeightM}};
  return room;
}

RoomShell CorridorOf(const RoomShell& room) {
  RoomShell corridor;
  corridor.corner_m = {0.0, -kWallThicknessM - kCorridorWidthM};
  corridor.size_m = {kTwinShiftM + kRoomM, kCorridorWidthM};
  corridor.walls = {room.walls[3], room.walls[2], room.walls[3], room.walls[2]};
  corridor.floor = room.floor;
  corridor.ceiling = room.ceiling;
  for (const double x : {kDoorXM, kTwinShiftM + kDoorXM}) {
    corridor.openings.push_back(
        {Wall::kNorth, x - 0.5 * kDoorwayM, x + 0.5 * kDoorwayM, kDoorwayHeightM});
  }
  return corridor;
}

void FurnishRoom(RoomDecorator& room) {
  room.AgainstWall(PropKind::kBookcase, Wall::kNorth, 0.8);
  room.Put(PropKind::kMonitor, room.AgainstWall(PropKind::kDesk, Wall::kNorth, 2.4));
  room.Hang(Wall::kNorth, 2.4, 1.35, 0.9);
  room.AgainstWall(PropKind::kPottedPlant, Wall::kNorth, 3.9);
  room.Put(PropKind::kCarton, room.AgainstWall(PropKind::kCabinet, Wall::kEast, 1.1));
  room.Hang(Wall::kEast, 2.2, 1.0, 0.8);
  room.AgainstWall(PropKind::kChair, Wall::kEast, 2.3, 0.2);
  room.AgainstWall(PropKind::kBookcase, Wall::kEast, 3.5);
  room.AgainstWall(PropKind::kSuitcase, Wall::kSouth, 0.8);
  room.Hang(Wall::kSouth, 0.8, 1.1, 0.8);
  room.Hang(Wall::kSouth, 3.8, 0.9, 0.8);
  room.AgainstWall(PropKind::kCarton, Wall::kSouth, 3.9, 0.2);
  room.AgainstWall(PropKind::kBookcase, Wall::kWest, 0.9);
  room.Hang(Wall::kWest, 2.2, 1.1, 0.9);
  room.Put(PropKind::kTeddyBear, room.AgainstWall(PropKind::kCabinet, Wall::kWest, 2.2));
  room.Put(PropKind::kCarton, room.AgainstWall(PropKind::kCarton, Wall::kWest, 3.7));
}

void FurnishCorridor(RoomDecorator& corridor) {
  const double length_m = kTwinShiftM + kRoomM;
  for (double along_m = 0.8; along_m < length_m - 0.5; along_m += 1.4)
    corridor.Hang(Wall::kSouth, along_m, 1.0, 0.8);
  corridor.Hang(Wall::kNorth, kDoorXM + 1.6, 1.0, 0.9);
  corridor.Hang(Wall::kNorth, kDoorXM + 3.2, 0.9, 0.8);
  corridor.AgainstWall(PropKind::kCarton, Wall::kNorth, kDoorXM + 2.4, 0.2);
  corridor.AgainstWall(PropKind::kPottedPlant, Wall::kWest, 1.0);
  corridor.AgainstWall(PropKind::kBookcase, Wall::kEast, 1.0);
}

// Appends what of the mesh lies north of the corridor once more, moved along x: the same texture
// in the same place, which a second shell would not have.
void AddTwinShell(Mesh& mesh) {
  const std::size_t vertices = mesh.positions.size();
  const std::size_t triangles = mesh.triangles.size();
  std::vector<std::uint32_t> twin_of(vertices, 0);
  for (std::size_t i = 0; i < vertices; ++i) {
    if (static_cast<double>(mesh.positions[i].y()) < -0.5 * kWallThicknessM) continue;
    twin_of[i] = static_cast<std::uint32_t>(mesh.positions.size());
    const Eigen::Vector3f moved =
        mesh.positions[i] + Eigen::Vector3f(static_cast<float>(kTwinShiftM), 0.0F, 0.0F);
    mesh.positions.push_back(moved);
    mesh.normals.push_back(Eigen::Vector3f(mesh.normals[i]));
    mesh.uvs.push_back(Eigen::Vector2f(mesh.uvs[i]));
  }
  for (std::size_t i = 0; i < triangles; ++i) {
    Triangle twin = mesh.triangles[i];
    for (std::uint32_t& vertex : twin.vertices)
      vertex = twin_of[vertex];
    if (std::ranges::all_of(twin.vertices, [](std::uint32_t v) { return v > 0; }))
      mesh.triangles.push_back(twin);
  }
}

void AddTwins(Scene& scene, std::size_t first, std::size_t end) {
  AddTwinShell(scene.objects[0].mesh);
  const Se3 shift(Eigen::Quaterniond::Identity(), {kTwinShiftM, 0.0, 0.0});
  for (std::size_t i = first; i < end; ++i) {
    SceneObject twin = scene.objects[i];
    twin.name += "_twin";
    twin.T_world_object = shift * twin.T_world_object;
    scene.objects.push_back(std::move(twin));
  }
}

// Around in the first room, through the corridor, and around in the second in the same way.
CameraMotion Visits(const StoryOptions& options) {
  constexpr double kHandHeightM = 1.25;
  constexpr double kPitchRad = -8.0 * kDegree;
  const double visit_share = options.is_short ? 0.3 : 0.36;  // of the time, for each room
  const double whole_s = options.is_short ? kShortTwinsS : kTwinsS;
  const double leave_s = visit_share * whole_s;
  const double enter_s = whole_s - leave_s;
  RingWalk ring;
  ring.center_m = {0.5 * kRoomM, 0.5 * kRoomM};
  ring.radius_m = 0.95;
  ring.height_m = kHandHeightM;
  ring.from_deg = -80.0;  // with the door behind
  ring.to_deg = 260.0;
  ring.lead_deg = 165.0;  // the gaze goes across the room
  std::vector<TimedView> views = RingViews(ring, 0.0, leave_s);
  const auto add = [&](double share, double x, double y, double yaw_deg) {
    views.push_back({std::lerp(leave_s, enter_s, share),
                     {{x, y, kHandHeightM}, yaw_deg * kDegree, kPitchRad},
                     0.0});
  };
  add(0.20, kDoorXM, 0.3, 300.0);
  add(0.34, kDoorXM + 0.45, kCorridorYM + 0.1, 345.0);
  add(0.70, kTwinShiftM + kDoorXM - 0.45, kCorridorYM, 370.0);
  add(0.84, kTwinShiftM + kDoorXM, 0.2, 430.0);
  ring.center_m.x() += kTwinShiftM;
  for (TimedView view : RingViews(ring, enter_s, whole_s)) {
    view.view.yaw_rad += 360.0 * kDegree;
    views.push_back(view);
  }
  HandTremor tremor;
  tremor.seed = options.seed;
  return HandheldMotion(std::move(views), 0.6, tremor);
}

}  // namespace

Story MakeTwins(const Stage& stage, const StoryOptions& options) {
  SceneBuilder scene(options.seed, kStoryLightCellM);
  Rng rng(options.seed, 0, 62);
  std::array<RoomShell, 2> shells{FirstRoom(scene, stage.props, rng), RoomShell()};
  shells[1] = CorridorOf(shells[0]);
  AddShells(scene, shells);
  RoomDecorator corridor(stage.props, scene, shells[1], options.seed);
  FurnishCorridor(corridor);
  const int first = scene.AddBox("rug", kNoClass, Standing(2.3, 2.5, 0.0, 0.06), {2.2, 1.6, 0.012},
                                 Uniform(stage.props.AddSurface(scene, SurfaceKind::kRug, 5)));
  RoomDecorator room(stage.props, scene, shells[0], options.seed + 1);
  FurnishRoom(room);
  AddDoorway(scene, {kDoorXM, -0.5 * kWallThicknessM}, kDoorwayM, false,
             stage.props.AddSurface(scene, SurfaceKind::kWood, 3));
  std::array<RoomShell, 3> lit{shells[0], shells[1], shells[0]};
  lit[2].corner_m.x() += kTwinShiftM;
  Story story;
  story.world.scene = scene.Take(RoomLighting(lit));
  AddTwins(story.world.scene, static_cast<std::size_t>(first), story.world.scene.objects.size());
  story.camera = Visits(options);
  return story;
}

}  // namespace cslam
