// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/sim/scene_builder.h"
#include "cslam/sim/world.h"

#include <opencv2/core.hpp>

#include <optional>
#include <utility>

namespace cslam::test {

// Instance ids of MakeTestWorld().
constexpr int kBox = 1;
constexpr int kBody = 2;
constexpr int kTable = 3;

// A lit hall of 6 x 6 x 3 m (object 0) with the camera expected around (0, -2.5, 1), looking along
// +y. A red box of 0.4 m (1) rests at x = -1 until 2 s, is carried to x = 1 until 4 s, rests there
// and is taken away at 6 s. A green body (2, a column of 0.3 x 0.3 x 1.6 m whose vertices are
// animated) walks along y = -0.5 from x = 2 at 1 s to x = -2 at 5 s, and is away before and after.
// A blue table (3) rests at x = 0.
inline World MakeTestWorld() {
  SceneBuilder scene(1, 0.25);
  const auto plain = [&](int blue, int green, int red) {
    return scene.AddPicture(cv::Mat(4, 4, CV_8UC3, cv::Scalar(blue, green, red)));
  };
  const int white = plain(200, 200, 200);
  const Eigen::Vector3d x(6.0, 0.0, 0.0);
  const Eigen::Vector3d y(0.0, 6.0, 0.0);
  const Eigen::Vector3d z(0.0, 0.0, 3.0);
  const Eigen::Vector3d corner(-3.0, -3.0, 0.0);
  scene.AddObject("hall", kNoClass, Se3(), [&](MeshBuilder& mesh) {
    mesh.AddRectangle(corner + y + z, x, -z, white);
    mesh.AddRectangle(corner + y, x, -y, white);
  });
  scene.AddBox("box", kNoClass, Standing(-1.0, 0.5, 0.0), {0.4, 0.4, 0.4},
               Uniform(plain(0, 0, 200)));
  scene.AddBox("body", 0, Se3(), {0.3, 0.3, 1.6}, Uniform(plain(0, 200, 0)));
  scene.AddBox("table", 60, Standing(0.0, 1.5, 0.0), {0.8, 0.8, 0.7}, Uniform(plain(200, 0, 0)));
  Lighting lighting;
  lighting.lights.push_back({{-0.5, -0.5, 2.9}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, 6.0});
  World world{scene.Take(lighting), {}, {}};
  Timeline& box = world.timelines[kBox];
  box.stays = {{.to_s = 2.0, .T_world_object = Standing(-1.0, 0.5, 0.0)},
               {.from_s = 4.0, .to_s = 6.0, .T_world_object = Standing(1.0, 0.5, 0.0)}};
  box.carries = {{{2.0, Standing(-1.0, 0.5, 0.0)}, {4.0, Standing(1.0, 0.5, 0.0)}}};
  const Mesh mesh = world.scene.objects[kBody].mesh;
  world.animations[kBody] = [mesh](double time_s) -> std::optional<BodyShape> {
    if (time_s < 1.0 || time_s >= 5.0) return std::nullopt;
    BodyShape shape{mesh.positions, mesh.normals, Standing(3.0 - time_s, -0.5, 0.0)};
    for (Eigen::Vector3f& p : shape.positions)
      p += shape.T_world_body.translation.cast<float>();
    return shape;
  };
  return world;
}

}  // namespace cslam::test
