// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/sim/scene.h"
#include "cslam/sim/scene_builder.h"

#include <opencv2/core.hpp>

namespace cslam {

// For tests: a white wall at y = 3 m (object 0) and a red box of 0.4 m (object 1, COCO class 56)
// whose front face is at y = 1.8 m, around x = 0 and from z = 0.8 m to 1.2 m. Everything shines by
// itself, so colours are known.
inline Scene MakeTestScene() {
  SceneBuilder scene(1, 0.5);
  const int white = scene.AddPicture(cv::Mat(4, 4, CV_8UC3, cv::Scalar(240, 240, 240)), 1.0F);
  const int red = scene.AddPicture(cv::Mat(4, 4, CV_8UC3, cv::Scalar(0, 0, 200)), 1.0F);
  scene.AddObject("wall", kNoClass, Se3(), [&](MeshBuilder& mesh) {
    mesh.AddRectangle({-5.0, 3.0, 5.0}, {10.0, 0.0, 0.0}, {0.0, 0.0, -10.0}, white);
  });
  scene.AddBox("box", 56, Standing(0.0, 2.0, 0.8), {0.4, 0.4, 0.4}, Uniform(red));
  return scene.Take(Lighting{});
}

}  // namespace cslam
