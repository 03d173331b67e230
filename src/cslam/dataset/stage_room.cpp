// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/stage_room.h"

#include "cslam/sim/picture_paint.h"
#include "cslam/util/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace cslam {
namespace {

constexpr double kGapM = 0.02;  // between furniture and the wall
constexpr double kPosterThicknessM = 0.012;
constexpr double kRugThicknessM = 0.012;
constexpr double kJitterM = 0.03;  // furniture is never twice in the same place
constexpr double kJitterRad = 0.02;
constexpr double kDoorWidthM = 0.9;
constexpr double kDoorHeightM = 2.03;
constexpr double kDoorTexelsPerM = 500.0;
constexpr double kLampSpacingM = 2.8;
constexpr double kLampRadiance = 5.0;

// Where a wall begins (its left end as seen from inside, on the floor) and which way it runs.
struct WallLine {
  Eigen::Vector3d start;
  Eigen::Vector3d along;   // unit
  Eigen::Vector3d inward;  // unit
  double yaw_rad = 0.0;    // of things that stand at it
};

WallLine LineOf(const RoomShell& room, Wall wall) {
  const Eigen::Vector3d low(room.corner_m.x(), room.corner_m.y(), 0.0);
  const Eigen::Vector3d x(room.size_m.x(), 0.0, 0.0);
  const Eigen::Vector3d y(0.0, room.size_m.y(), 0.0);
  const Eigen::Vector3d ex = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d ey = Eigen::Vector3d::UnitY();
  switch (wall) {
    case Wall::kNorth:
      return {low + y, ex, -ey, 0.0};
    case Wall::kEast:
      return {low + x + y, -ey, -ex, -0.5 * std::numbers::pi};
    case Wall::kSouth:
      return {low + x, -ex, ey, std::numbers::pi};
    case Wall::kWest:
      return {low, ey, ex, 0.5 * std::numbers::pi};
  }
  CSLAM_CHECK(false, "wall {}", static_cast<int>(wall));
}

void AddWall(MeshBuilder& mesh, const RoomShell& room, Wall wall) {
  const WallLine line = LineOf(room, wall);
  const int material = room.walls[static_cast<std::size_t>(wall)];
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const auto piece = [&](double from, double to, double bottom, double top) {
    if (to - from < 1e-6 || top - bottom < 1e-6) return;
    mesh.AddRectangle(line.start + from * line.along + top * up, (to - from) * line.along,
                      -(top - bottom) * up, material);
  };
  std::vector<Opening> openings;
  std::ranges::copy_if(room.openings, std::back_inserter(openings),
                       [&](const Opening& o) { return o.wall == wall; });
  std::ranges::sort(openings, {}, &Opening::from_m);
  double at = 0.0;
  for (const Opening& opening : openings) {
    CSLAM_CHECK(opening.from_m >= at && opening.to_m > opening.from_m);
    piece(at, opening.from_m, 0.0, room.height_m);
    piece(opening.from_m, opening.to_m, opening.height_m, room.height_m);
    at = opening.to_m;
  }
  piece(at, LengthOf(room, wall), 0.0, room.height_m);
}

void AddLamps(Lighting& lighting, const RoomShell& room) {
  const auto lamps = [](double length) {
    return std::max(1, static_cast<int>(std::lround(length / kLampSpacingM)));
  };
  const int columns = lamps(room.size_m.x());
  const int rows = std::max(1, lamps(room.size_m.y()) - 1);
  const Eigen::Vector3d edge_u(0.0, 1.2, 0.0);
  const Eigen::Vector3d edge_v(0.5, 0.0, 0.0);
  for (int c = 0; c < columns; ++c) {
    for (int r = 0; r < rows; ++r) {
      const Eigen::Vector3d middle(room.corner_m.x() + room.size_m.x() * (c + 0.5) / columns,
                                   room.corner_m.y() + room.size_m.y() * (r + 0.5) / rows,
                                   room.height_m - 0.05);
      lighting.lights.push_back(
          {middle - 0.5 * edge_u - 0.5 * edge_v, edge_u, edge_v, kLampRadiance});
    }
  }
}

}  // namespace

void AddShells(SceneBuilder& scene, std::span<const RoomShell> rooms) {
  const int id = scene.AddObject("room", kNoClass, Se3(), [&](MeshBuilder& mesh) {
    for (const RoomShell& room : rooms) {
      for (const Wall wall : {Wall::kNorth, Wall::kEast, Wall::kSouth, Wall::kWest})
        AddWall(mesh, room, wall);
      const Eigen::Vector3d low(room.corner_m.x(), room.corner_m.y(), 0.0);
      const Eigen::Vector3d x(room.size_m.x(), 0.0, 0.0);
      const Eigen::Vector3d y(0.0, room.size_m.y(), 0.0);
      const Eigen::Vector3d z(0.0, 0.0, room.height_m);
      mesh.AddRectangle(low + y, x, -y, room.floor);
      mesh.AddRectangle(low + z, x, y, room.ceiling);
    }
  });
  CSLAM_CHECK(id == 0, "the rooms have to be the scene's first object");
}

Lighting RoomLighting(std::span<const RoomShell> rooms) {
  Lighting lighting;
  for (const RoomShell& room : rooms)
    AddLamps(lighting, room);
  lighting.ambient = 0.35;
  lighting.exposure = 2.2;
  return lighting;
}

double LengthOf(const RoomShell& room, Wall wall) {
  return wall == Wall::kNorth || wall == Wall::kSouth ? room.size_m.x() : room.size_m.y();
}

Se3 AtWall(const RoomShell& room, Wall wall, double along_m, double out_m, double z_m,
           double turn_rad) {
  const WallLine line = LineOf(room, wall);
  const Eigen::Vector3d p = line.start + along_m * line.along + out_m * line.inward;
  return Standing(p.x(), p.y(), z_m, line.yaw_rad + turn_rad);
}

RoomDecorator::RoomDecorator(const PropLibrary& props, SceneBuilder& scene, RoomShell room,
                             std::uint64_t seed)
    : props_(props),
      scene_(scene),
      room_(std::move(room)),
      rng_(seed, 0, 41),
      next_poster_(AnyVariant()) {}

Se3 RoomDecorator::AgainstWall(PropKind kind, Wall wall, double along_m, double turn_rad) {
  const int variant = AnyVariant();
  const Eigen::Vector3d size = props_.SizeM(kind, variant);
  const double turn = turn_rad + Jitter(kJitterRad);
  // A turned box reaches further back.
  const double back_m =
      0.5 * (size.y() * std::abs(std::cos(turn)) + size.x() * std::abs(std::sin(turn)));
  const double along = along_m + Jitter(kJitterM);
  const double out = back_m + kGapM + rng_.Uniform(0.0, kJitterM);
  props_.Add(scene_, kind, variant, std::string(NameOf(kind)),
             AtWall(room_, wall, along, out, 0.0, turn));
  return AtWall(room_, wall, along, out, props_.TopM(kind, variant), turn);
}

int RoomDecorator::Put(PropKind kind, const Se3& T_world_place) {
  return props_.Add(scene_, kind, AnyVariant(), std::string(NameOf(kind)), T_world_place);
}

void RoomDecorator::Hang(Wall wall, double along_m, double bottom_m, double width_m) {
  const cv::Mat picture = props_.Poster(next_poster_++);
  const double height_m = width_m * picture.rows / picture.cols;
  scene_.AddBox("poster", kNoClass,
                AtWall(room_, wall, along_m + Jitter(kJitterM), 0.5 * kPosterThicknessM + 0.002,
                       bottom_m + Jitter(kJitterM)),
                {width_m, kPosterThicknessM, height_m}, Uniform(scene_.AddPicture(picture)));
}

void RoomDecorator::Door(Wall wall, double along_m) {
  const cv::Size texels(static_cast<int>(kDoorWidthM * kDoorTexelsPerM),
                        static_cast<int>(kDoorHeightM * kDoorTexelsPerM));
  const int paint = scene_.AddPicture(PaintDoor(texels, kDoorTexelsPerM, scene_.NextRng()));
  scene_.AddBox("door", kNoClass, AtWall(room_, wall, along_m, 0.02),
                {kDoorWidthM, 0.03, kDoorHeightM}, Uniform(paint));
}

void RoomDecorator::Rug(const Se3& T_world_rug, const Eigen::Vector2d& size_m, SurfaceKind kind,
                        int variant) {
  scene_.AddBox("rug", kNoClass, T_world_rug, {size_m.x(), size_m.y(), kRugThicknessM},
                Uniform(props_.AddSurface(scene_, kind, variant)));
}

}  // namespace cslam
