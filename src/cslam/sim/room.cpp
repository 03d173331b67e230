// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/room.h"

#include "cslam/sim/furniture.h"
#include "cslam/sim/paint_tools.h"
#include "cslam/sim/picture_paint.h"
#include "cslam/sim/scene_builder.h"
#include "cslam/sim/surface_paint.h"

#include <numbers>

namespace cslam {
namespace {

constexpr double kLengthM = 6.0;  // x
constexpr double kWidthM = 5.0;   // y
constexpr double kHeightM = 2.7;  // z

// Poses on the walls: along says how far from the left (m) as one looks at the wall, out how far
// from it, z how high. The front of what stands there faces the room.
Se3 North(double along, double out, double z = 0.0) {
  return Standing(along, kWidthM - out, z);
}
Se3 East(double along, double out, double z = 0.0) {
  return Standing(kLengthM - out, kWidthM - along, z, -0.5 * std::numbers::pi);
}
Se3 South(double along, double out, double z = 0.0) {
  return Standing(kLengthM - along, out, z, std::numbers::pi);
}
Se3 West(double along, double out, double z = 0.0) {
  return Standing(out, along, z, 0.5 * std::numbers::pi);
}

// Builds the study piece by piece; the order is part of what a seed means.
class Study {
 public:
  explicit Study(const RoomOptions& options)
      : scale_(options.texels_per_m),
        scene_(options.seed, options.light_cell_m),
        furnish_(scene_, options.texels_per_m) {}

  Scene Build() {
    AddShell();
    FurnishNorth();
    FurnishEast();
    FurnishSouth();
    FurnishWest();
    FurnishMiddle();
    return scene_.Take(Lights());
  }

 private:
  static constexpr double kShellDetail = 0.4;  // walls and floor are seen from afar

  // The first object: instance 0 is the room.
  void AddShell() {
    const double scale = kShellDetail * scale_;
    const cv::Size long_wall = TexelSize(kLengthM, kHeightM, scale);
    const cv::Size short_wall = TexelSize(kWidthM, kHeightM, scale);
    const cv::Size ground = TexelSize(kLengthM, kWidthM, scale);
    const int north =
        scene_.AddPicture(PaintPlaster(long_wall, scale, {176, 206, 214}, scene_.NextRng()));
    const int east = scene_.AddPicture(PaintBricks(short_wall, scale, scene_.NextRng()));
    const int south =
        scene_.AddPicture(PaintWallpaper(long_wall, scale, {168, 190, 160}, scene_.NextRng()));
    const int west =
        scene_.AddPicture(PaintPlaster(short_wall, scale, {206, 188, 166}, scene_.NextRng()));
    const int floor = scene_.AddPicture(PaintPlanks(ground, scale, scene_.NextRng()));
    const int ceiling = scene_.AddPicture(PaintCeiling(ground, scale, scene_.NextRng()));
    const Eigen::Vector3d x(kLengthM, 0.0, 0.0);
    const Eigen::Vector3d y(0.0, kWidthM, 0.0);
    const Eigen::Vector3d z(0.0, 0.0, kHeightM);
    scene_.AddObject("room", kNoClass, Se3(), [&](MeshBuilder& mesh) {
      mesh.AddRectangle(y + z, x, -z, north);
      mesh.AddRectangle(x + y + z, -y, -z, east);
      mesh.AddRectangle(x + z, -x, -z, south);
      mesh.AddRectangle(z, y, -z, west);
      mesh.AddRectangle(y, x, -y, floor);
      mesh.AddRectangle(z, x, y, ceiling);
    });
  }

  cv::Size Texels(double width_m, double height_m) const {
    return TexelSize(width_m, height_m, scale_);
  }

  void FurnishNorth() {
    furnish_.Shelf(North(0.75, 0.17), {1.1, 0.32, 2.05}, 6);
    furnish_.Desk(North(2.45, 0.4), 1.7);
    furnish_.Monitor(North(2.25, 0.3, 0.74), 0.56);
    furnish_.Keyboard(North(2.2, 0.56, 0.74));
    furnish_.Page(North(2.62, 0.55, 0.74) * Standing(0.0, 0.0, 0.0, 0.3));
    furnish_.Clutter(North(2.95, 0.36, 0.74), 0.6, 0.4, 2);
    furnish_.Clutter(North(1.8, 0.25, 0.74), 0.3, 0.3, 1);
    furnish_.Chair(North(2.2, 0.95) * Standing(0.0, 0.0, 0.0, 2.8));
    furnish_.OnWall("poster", North(2.0, 0.0, 1.35), 0.62, 0.86,
                    PaintPoster(Texels(0.62, 0.86), scene_.NextRng()));
    furnish_.OnWall("notes", North(3.0, 0.0, 1.3), 1.1, 0.75,
                    PaintNotesBoard(Texels(1.1, 0.75), scene_.NextRng()));
    furnish_.Cabinet(North(4.15, 0.25), {0.9, 0.45, 1.15}, 4);
    furnish_.Clutter(North(4.15, 0.25, 1.15), 0.85, 0.35, 4);
    furnish_.OnWall("picture", North(4.2, 0.0, 1.65), 0.5, 0.36,
                    PaintPhoto(Texels(0.5, 0.36), scene_.NextRng()));
    furnish_.OnWall("poster", North(5.2, 0.0, 1.1), 0.6, 0.85,
                    PaintPoster(Texels(0.6, 0.85), scene_.NextRng()));
    furnish_.Carton(North(5.25, 0.35) * Standing(0.0, 0.0, 0.0, 0.25), {0.55, 0.42, 0.4});
    furnish_.Carton(North(5.3, 0.33, 0.4) * Standing(0.0, 0.0, 0.0, -0.2), {0.42, 0.34, 0.3});
  }

  void FurnishEast() {
    furnish_.Desk(East(1.65, 0.4), 1.6);
    furnish_.Monitor(East(1.35, 0.28, 0.74) * Standing(0.0, 0.0, 0.0, 0.15), 0.52);
    furnish_.Monitor(East(1.95, 0.28, 0.74) * Standing(0.0, 0.0, 0.0, -0.2), 0.6);
    furnish_.Keyboard(East(1.6, 0.58, 0.74));
    furnish_.BookPile(East(1.05, 0.5, 0.74), 4);
    furnish_.Cup(East(2.05, 0.6, 0.74));
    furnish_.Page(East(2.28, 0.5, 0.74) * Standing(0.0, 0.0, 0.0, -0.4));
    furnish_.OnWall("picture", East(1.2, 0.0, 1.55), 0.7, 0.5,
                    PaintPhoto(Texels(0.7, 0.5), scene_.NextRng()));
    furnish_.OnWall("poster", East(2.1, 0.0, 1.4), 0.55, 0.78,
                    PaintPoster(Texels(0.55, 0.78), scene_.NextRng()));
    furnish_.Shelf(East(3.25, 0.16), {0.9, 0.3, 1.75}, 5);
    furnish_.Cabinet(East(4.3, 0.25), {0.7, 0.45, 0.8}, 2);
    furnish_.Clutter(East(4.3, 0.25, 0.8), 0.65, 0.35, 3);
    furnish_.OnWall("poster", East(4.35, 0.0, 1.35), 0.8, 0.56,
                    PaintPoster(Texels(0.8, 0.56), scene_.NextRng()));
  }

  void FurnishSouth() {
    furnish_.OnWall("door", South(0.75, 0.0), 0.9, 2.05,
                    PaintDoor(Texels(0.9, 2.05), scale_, scene_.NextRng()));
    furnish_.Sofa(South(2.6, 0.45), 1.9);
    furnish_.OnWall("picture", South(2.2, 0.0, 1.25), 0.95, 0.65,
                    PaintPhoto(Texels(0.95, 0.65), scene_.NextRng()));
    furnish_.OnWall("poster", South(3.2, 0.0, 1.2), 0.5, 0.7,
                    PaintPoster(Texels(0.5, 0.7), scene_.NextRng()));
    furnish_.Cabinet(South(4.4, 0.24), {1.3, 0.42, 0.62}, 2);
    furnish_.Clutter(South(4.4, 0.24, 0.62), 1.2, 0.35, 5);
    furnish_.OnWall("notes", South(4.5, 0.0, 1.25), 0.9, 0.65,
                    PaintNotesBoard(Texels(0.9, 0.65), scene_.NextRng()));
    furnish_.Carton(South(5.45, 0.3) * Standing(0.0, 0.0, 0.0, 0.3), {0.5, 0.4, 0.45});
    furnish_.Package(South(5.5, 0.3, 0.45) * Standing(0.0, 0.0, 0.0, -0.3), {0.35, 0.25, 0.3});
  }

  void FurnishWest() {
    furnish_.Cabinet(West(0.9, 0.22), {0.8, 0.4, 1.3}, 5);
    furnish_.Clutter(West(0.9, 0.22, 1.3), 0.7, 0.3, 3);
    scene_.AddBox(
        "window", kNoClass, West(2.3, 0.01, 0.95), {1.3, 0.02, 1.25},
        Uniform(scene_.AddPicture(PaintPhoto(Texels(1.3, 1.25), scene_.NextRng()), 1.15F)));
    furnish_.Table(West(2.2, 0.35), {1.5, 0.6, 0.7});
    furnish_.Clutter(West(2.2, 0.35, 0.7), 1.4, 0.45, 6);
    furnish_.Carton(West(1.9, 0.4), {0.5, 0.45, 0.38});
    furnish_.Chair(West(2.5, 0.8) * Standing(0.0, 0.0, 0.0, 3.5));
    furnish_.OnWall("whiteboard", West(3.75, 0.0, 1.0), 1.3, 0.9,
                    PaintWhiteboard(Texels(1.3, 0.9), scene_.NextRng()));
    furnish_.Cabinet(West(3.9, 0.24), {1.0, 0.42, 0.75}, 3);
    furnish_.Clutter(West(3.9, 0.24, 0.75), 0.9, 0.3, 3);
  }

  void FurnishMiddle() {
    scene_.AddBox(
        "rug", kNoClass, Standing(2.95, 2.4, 0.0, 0.06), {2.4, 1.7, 0.012},
        Uniform(scene_.AddPicture(PaintRug(Texels(2.4, 1.7), 0.7 * scale_, scene_.NextRng()))));
    const Se3 T_world_table = Standing(3.0, 2.45, 0.012, 0.2);
    furnish_.Table(T_world_table, {0.8, 0.55, 0.42});
    furnish_.BookPile(T_world_table * Standing(-0.2, 0.05, 0.42), 3);
    furnish_.Cup(T_world_table * Standing(0.1, -0.12, 0.42));
    furnish_.Page(T_world_table * Standing(0.22, 0.06, 0.42, 0.7));
    furnish_.Carton(Standing(5.35, 0.9, 0.0, 0.5), {0.4, 0.35, 0.32});
    furnish_.Chair(Standing(4.95, 2.75, 0.0, 1.4));
  }

  static Lighting Lights() {
    Lighting lighting;
    constexpr double kLampHeightM = kHeightM - 0.05;
    for (const double x : {1.6, 4.2}) {
      lighting.lights.push_back({{x, 1.9, kLampHeightM}, {0.0, 1.2, 0.0}, {0.5, 0.0, 0.0}, 5.0});
    }
    lighting.lights.push_back({{0.05, 1.65, 0.95}, {0.0, 1.3, 0.0}, {0.0, 0.0, 1.25}, 3.0});
    lighting.ambient = 0.32;
    lighting.exposure = 2.4;
    return lighting;
  }

  double scale_;
  SceneBuilder scene_;
  Furnisher furnish_;
};

}  // namespace

Scene MakeRoom(const RoomOptions& options) {
  return Study(options).Build();
}

}  // namespace cslam
