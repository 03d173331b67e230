// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/vision/pixel_rays.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

TEST(PixelRays, GoThroughTheMiddleOfTheFullSizePixels) {
  Camera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 500.0;
  camera.cx = 320.0;
  camera.cy = 240.0;
  camera.k1 = 0.1;
  const PixelRays rays(camera, {160, 120});
  const Eigen::Vector3d& ray = rays.At(10, 20);
  EXPECT_EQ(ray.z(), 1.0);
  const Eigen::Vector2d expected = Undistort(camera, Eigen::Vector2d(42.0, 82.0));
  EXPECT_LT((Project(camera, 3.0 * ray) - expected).norm(), 1e-9);
}

}  // namespace
}  // namespace cslam
