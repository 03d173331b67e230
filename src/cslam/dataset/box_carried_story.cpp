// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/handheld_motion.h"
#include "cslam/dataset/office_stage.h"
#include "cslam/dataset/stage_room.h"
#include "cslam/dataset/stress_stories.h"
#include "cslam/sim/paint_tools.h"
#include "cslam/sim/surface_paint.h"
#include "cslam/util/check.h"

#include <cmath>
#include <limits>
#include <vector>

namespace cslam {
namespace {

// Where the cart is at a time; two equal places in a row are a halt.
struct CartStop {
  double time_s = 0.0;
  double x = 0.0;
  double y = 0.0;
  double yaw_rad = 0.0;
};

// Two cartons, one on the other, on a flat cart: about 0.8 x 0.6 x 1.4 m, one rigid body.
int AddCart(SceneBuilder& scene, double texels_per_m) {
  constexpr double kDeckM = 0.16;
  const Eigen::Vector3d lower(0.78, 0.58, 0.66);
  const Eigen::Vector3d upper(0.6, 0.46, 0.52);
  const auto cardboard = [&](double width_m, double height_m) {
    return scene.AddPicture(
        PaintCardboard(TexelSize(width_m, height_m, texels_per_m), texels_per_m, scene.NextRng()));
  };
  const auto carton = [&](const Eigen::Vector3d& size) {
    BoxLook look{};
    for (std::size_t face = 0; face < 2; ++face)
      look[face] = cardboard(size.x(), size.z());
    for (std::size_t face = 2; face < 4; ++face)
      look[face] = cardboard(size.y(), size.z());
    look[4] = cardboard(size.x(), size.y());
    look[5] = -1;
    return look;
  };
  const BoxLook lower_look = carton(lower);
  const BoxLook upper_look = carton(upper);
  const int metal =
      scene.AddSurface(PaintPlain({160, 160}, {92, 88, 84}, scene.NextRng()), 0.4, 0.4);
  return scene.AddObject("cart", kNoClass, Se3(), [&](MeshBuilder& mesh) {
    mesh.AddBox(Standing(0.0, 0.0, 0.12), {0.86, 0.64, 0.04}, Uniform(metal));
    for (const double x : {-0.34, 0.34}) {
      for (const double y : {-0.24, 0.24})
        mesh.AddBox(Standing(x, y, 0.0), {0.1, 0.05, 0.12}, Uniform(metal));
    }
    mesh.AddBox(Standing(0.0, 0.0, kDeckM), lower, lower_look);
    mesh.AddBox(Standing(0.05, -0.02, kDeckM + lower.z(), 0.25), upper, upper_look);
  });
}

Se3 PoseOf(const CartStop& stop) {
  return Standing(stop.x, stop.y, 0.0, stop.yaw_rad);
}

// Rolls from stop to stop, starting and braking softly.
Timeline Roll(const std::vector<CartStop>& stops) {
  constexpr double kSampleS = 1.0 / 30.0;
  constexpr double kForever = std::numeric_limits<double>::infinity();
  Timeline timeline;
  double rest_since_s = -kForever;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    const CartStop& from = stops[i];
    const CartStop& to = stops[i + 1];
    if (from.x == to.x && from.y == to.y) continue;
    timeline.stays.push_back({rest_since_s, from.time_s, PoseOf(from)});
    const double length_s = to.time_s - from.time_s;
    const auto samples = static_cast<int>(std::ceil(length_s / kSampleS));
    Carry carry;
    for (int k = 0; k <= samples; ++k) {
      const double t = static_cast<double>(k) / samples;
      const double share = t * t * (3.0 - 2.0 * t);
      carry.push_back({from.time_s + t * length_s,
                       PoseOf({0.0, std::lerp(from.x, to.x, share), std::lerp(from.y, to.y, share),
                               std::lerp(from.yaw_rad, to.yaw_rad, share)})});
    }
    carry.back().time_s = to.time_s;
    timeline.carries.push_back(std::move(carry));
    rest_since_s = to.time_s;
  }
  timeline.stays.push_back({rest_since_s, kForever, PoseOf(stops.back())});
  return timeline;
}

}  // namespace

Story MakeBoxCarried(const Stage& stage, const StoryOptions& options) {
  constexpr double kSpeedMPerS = 0.2;
  SceneBuilder scene(options.seed, kStoryLightCellM);
  const Office office = AddOffice(scene, stage.props, {.seed = options.seed});
  const int cart = AddCart(scene, 0.6 * options.texels_per_m);
  Story story;
  story.world.timelines[cart] = Roll({{1.0, 1.0, 2.5, 0.1},
                                      {5.0, 3.35, 2.4, 0.0},
                                      {9.0, 3.35, 2.4, 0.0},
                                      {11.0, 4.1, 2.45, -0.1},
                                      {12.5, 4.1, 2.45, -0.1},
                                      {14.5, 5.9, 2.45, -0.1},
                                      {15.0, 5.9, 2.45, -0.1},
                                      {18.0, 3.5, 2.5, 0.3},
                                      {21.5, 3.5, 2.5, 0.3},
                                      {24.0, 3.0, 2.4, 0.1},
                                      {27.0, 3.0, 2.4, 0.1},
                                      {30.5, 1.0, 2.5, 0.0}});
  story.world.scene = scene.Take(RoomLighting({&office.room, 1}));
  story.camera = XyzHand(office.home, options.is_short ? kShortBoxCarriedS : kBoxCarriedS,
                         kSpeedMPerS, options.seed);
  return story;
}

}  // namespace cslam
