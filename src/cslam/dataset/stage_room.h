// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/assets/prop_library.h"
#include "cslam/geometry/se3.h"
#include "cslam/sim/scene.h"
#include "cslam/sim/scene_builder.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cslam {

// Sides of a rectangular room: +y, +x, -y, -x.
enum class Wall { kNorth, kEast, kSouth, kWest };

// A doorway: a stretch of a wall, in m from its left end as one looks at it from inside.
struct Opening {
  Wall wall = Wall::kNorth;
  double from_m = 0.0;
  double to_m = 0.0;
  double height_m = 2.05;
};

// A rectangular room without its furniture. Materials are those of one SceneBuilder.
struct RoomShell {
  Eigen::Vector2d corner_m = Eigen::Vector2d::Zero();  // its smallest x and y, world
  Eigen::Vector2d size_m = {7.0, 6.0};                 // along x and y
  double height_m = 2.7;
  std::array<int, 4> walls{};  // material by Wall
  int floor = 0;
  int ceiling = 0;
  std::vector<Opening> openings;
};

// Adds all rooms of a story as one object, which has to be the scene's first one: instance 0.
void AddShells(SceneBuilder& scene, std::span<const RoomShell> rooms);

// Ceiling lamps for each room, about two per 20 m2; exposure is set for rooms of plain colours.
Lighting RoomLighting(std::span<const RoomShell> rooms);

// Length of a wall in m.
double LengthOf(const RoomShell& room, Wall wall);

// A pose at a wall, its front (-y) towards the room, then turned to the left by turn_rad: along m
// from the wall's left end as one looks at it, out m from the wall, z m above the floor.
Se3 AtWall(const RoomShell& room, Wall wall, double along_m, double out_m, double z_m = 0.0,
           double turn_rad = 0.0);

// Furnishes one room. The seed picks variants and moves furniture by a few centimetres.
class RoomDecorator {
 public:
  RoomDecorator(const PropLibrary& props, SceneBuilder& scene, RoomShell room, std::uint64_t seed);

  const RoomShell& room() const { return room_; }
  Rng& rng() { return rng_; }

  // A prop of any variant with its back at the wall. Returns its pose with the origin lifted to
  // what one can put things on.
  Se3 AgainstWall(PropKind kind, Wall wall, double along_m, double turn_rad = 0.0);

  // A prop of any variant on T_world_place; returns its instance id.
  int Put(PropKind kind, const Se3& T_world_place);

  // A poster with a picture of its own, as far as there are enough; its height follows from it.
  void Hang(Wall wall, double along_m, double bottom_m, double width_m);

  // A closed door in a wall.
  void Door(Wall wall, double along_m);

  // A rug of the given size, 12 mm thick.
  void Rug(const Se3& T_world_rug, const Eigen::Vector2d& size_m, SurfaceKind kind, int variant);

 private:
  int AnyVariant() { return static_cast<int>(rng_.Index(1000)); }
  double Jitter(double amplitude) { return rng_.Uniform(-amplitude, amplitude); }

  const PropLibrary& props_;
  SceneBuilder& scene_;
  RoomShell room_;
  Rng rng_;
  int next_poster_ = 0;
};

// A living laboratory for the robot: every wall has furniture and pictures, the middle is free (at
// least 1.1 m from each wall). It has no thing of the classes that the robot's stories
// change, but for the books in its bookcases.
struct LabOptions {
  std::uint64_t seed = 1;
  Eigen::Vector2d size_m = {7.0, 6.0};  // at least 6 x 5
  int palette = 0;                      // which wallpapers and floors
  bool plain_north = false;  // nothing at the north wall, nor on it, nor a pattern before it
};
RoomShell AddLab(SceneBuilder& scene, const PropLibrary& props, const LabOptions& options);

// Spacing of the baked light that stories use (m).
constexpr double kStoryLightCellM = 0.12;

}  // namespace cslam
