// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/stage_room.h"
#include "cslam/util/check.h"

#include <array>
#include <cstddef>

namespace cslam {
namespace {

struct Palette {
  std::array<SurfaceKind, 4> walls;  // by Wall
  SurfaceKind floor;
  SurfaceKind rug;
};

constexpr std::array<Palette, 3> kPalettes{{
    {{SurfaceKind::kPlaster, SurfaceKind::kBrick, SurfaceKind::kWallpaper, SurfaceKind::kPlaster},
     SurfaceKind::kParquet,
     SurfaceKind::kRug},
    {{SurfaceKind::kWallpaper, SurfaceKind::kPlaster, SurfaceKind::kPlaster, SurfaceKind::kBrick},
     SurfaceKind::kParquet,
     SurfaceKind::kRug},
    {{SurfaceKind::kPlaster, SurfaceKind::kWallpaper, SurfaceKind::kBrick, SurfaceKind::kPlaster},
     SurfaceKind::kTiles,
     SurfaceKind::kRug},
}};

const Palette& PaletteOf(int number) {
  CSLAM_CHECK(number >= 0);
  return kPalettes[static_cast<std::size_t>(number) % kPalettes.size()];
}

RoomShell LabShell(SceneBuilder& scene, const PropLibrary& props, const LabOptions& options) {
  const Palette& palette = PaletteOf(options.palette);
  Rng rng(options.seed, 0, 42);
  const auto surface = [&](SurfaceKind kind) {
    return props.AddSurface(scene, kind, static_cast<int>(rng.Index(1000)));
  };
  RoomShell shell;
  shell.size_m = options.size_m;
  for (std::size_t i = 0; i < shell.walls.size(); ++i)
    shell.walls[i] = surface(palette.walls[i]);
  shell.floor = surface(palette.floor);
  shell.ceiling = surface(SurfaceKind::kPlaster);
  return shell;
}

// Along a wall in shares of its length, so that every size of room is filled.
class LabWalls {
 public:
  explicit LabWalls(RoomDecorator& room) : room_(room) {}

  void North() {
    room_.AgainstWall(PropKind::kBookcase, Wall::kNorth, At(Wall::kNorth, 0.10));
    room_.Hang(Wall::kNorth, At(Wall::kNorth, 0.25), 1.15, 0.65);
    Topped(PropKind::kCabinet, Wall::kNorth, 0.46, PropKind::kCarton);
    room_.Hang(Wall::kNorth, At(Wall::kNorth, 0.59), 1.2, 0.6);
    room_.Hang(Wall::kNorth, At(Wall::kNorth, 0.73), 1.1, 0.6);
    room_.AgainstWall(PropKind::kBookcase, Wall::kNorth, At(Wall::kNorth, 0.86));
    room_.AgainstWall(PropKind::kCarton, Wall::kNorth, At(Wall::kNorth, 0.96), 0.2);
  }

  void East() {
    Topped(PropKind::kCabinet, Wall::kEast, 0.16, PropKind::kCarton);
    room_.Hang(Wall::kEast, At(Wall::kEast, 0.33), 0.8, 0.75);
    room_.AgainstWall(PropKind::kBookcase, Wall::kEast, At(Wall::kEast, 0.52));
    Topped(PropKind::kCarton, Wall::kEast, 0.66, PropKind::kCarton);
    room_.Hang(Wall::kEast, At(Wall::kEast, 0.80), 0.9, 0.65);
    room_.AgainstWall(PropKind::kCarton, Wall::kEast, At(Wall::kEast, 0.86), -0.3);
  }

  void South() {
    room_.Door(Wall::kSouth, At(Wall::kSouth, 0.10));
    Topped(PropKind::kDesk, Wall::kSouth, 0.32, PropKind::kBackpack);
    room_.AgainstWall(PropKind::kCarton, Wall::kSouth, At(Wall::kSouth, 0.32), 0.2);
    room_.Hang(Wall::kSouth, At(Wall::kSouth, 0.32), 1.2, 0.7);
    room_.AgainstWall(PropKind::kBookcase, Wall::kSouth, At(Wall::kSouth, 0.54));
    room_.Hang(Wall::kSouth, At(Wall::kSouth, 0.69), 0.8, 0.65);
    Topped(PropKind::kCabinet, Wall::kSouth, 0.83, PropKind::kCarton);
    room_.AgainstWall(PropKind::kCarton, Wall::kSouth, At(Wall::kSouth, 0.95), 0.4);
  }

  void West() {
    room_.AgainstWall(PropKind::kBookcase, Wall::kWest, At(Wall::kWest, 0.16));
    room_.Hang(Wall::kWest, At(Wall::kWest, 0.34), 0.7, 0.75);
    Topped(PropKind::kCabinet, Wall::kWest, 0.53, PropKind::kCarton);
    room_.Hang(Wall::kWest, At(Wall::kWest, 0.68), 0.8, 0.6);
    Topped(PropKind::kCarton, Wall::kWest, 0.82, PropKind::kCarton);
  }

 private:
  double At(Wall wall, double share) const { return share * LengthOf(room_.room(), wall); }

  void Topped(PropKind below, Wall wall, double share, PropKind above) {
    const Se3 T_world_top = room_.AgainstWall(below, wall, At(wall, share));
    const double turn = room_.rng().Uniform(-0.3, 0.3);
    room_.Put(above, T_world_top * Standing(0.0, 0.0, 0.0, turn));
  }

  RoomDecorator& room_;
};

constexpr double kPlainRugDepthM = 3.0;
constexpr double kRugMarginM = 0.02;

}  // namespace

RoomShell AddLab(SceneBuilder& scene, const PropLibrary& props, const LabOptions& options) {
  CSLAM_CHECK(options.size_m.x() >= 6.0 && options.size_m.y() >= 5.0);
  const RoomShell shell = LabShell(scene, props, options);
  AddShells(scene, {&shell, 1});
  RoomDecorator room(props, scene, shell, options.seed);
  LabWalls walls(room);
  if (!options.plain_north) walls.North();
  walls.East();
  walls.South();
  walls.West();
  const Eigen::Vector2d middle = 0.5 * options.size_m;
  const int variant = static_cast<int>(room.rng().Index(1000));
  if (options.plain_north) {
    room.Rug(Standing(middle.x(), options.size_m.y() - 0.5 * kPlainRugDepthM - kRugMarginM, 0.0),
             {options.size_m.x() - 2.0 * kRugMarginM, kPlainRugDepthM}, SurfaceKind::kCarpet,
             variant);
  } else {
    room.Rug(Standing(middle.x(), middle.y(), 0.0, 0.05), {3.2, 2.2},
             PaletteOf(options.palette).rug, variant);
  }
  return shell;
}

}  // namespace cslam
