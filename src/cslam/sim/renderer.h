// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/geometry/se3.h"
#include "cslam/sim/resting_cache.h"
#include "cslam/sim/scene.h"
#include "cslam/sim/world.h"

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include <vector>

namespace cslam {

// One exact view. All images H x W.
struct RenderedView {
  cv::Mat bgr;           // CV_8UC3
  cv::Mat depth_m;       // CV_32FC1, along z at the pixel's centre; 0 where there is nothing
  cv::Mat instances;     // CV_16UC1, index into Scene::objects; 0 (the room) where there is nothing
  cv::Mat velocity_m_s;  // CV_32FC3, of the surface, world frame; empty if nothing moves
};

// Turns a world into images by casting one ray per pixel, and a few more where objects meet. The
// result depends on world, camera, pose and time alone. Const: one renderer serves many threads.
class Renderer {
 public:
  Renderer(World world, const Camera& camera);
  Renderer(Scene scene, const Camera& camera);  // in which nothing happens
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  RenderedView Render(const Se3& T_world_camera, double time_s = 0.0) const;

  const World& world() const { return world_; }
  const Camera& camera() const { return camera_; }

 private:
  World world_;
  Camera camera_;
  RestingCache resting_;
  std::vector<Eigen::Vector3f> pixel_rays_;  // camera frame, z = 1, row by row
};

}  // namespace cslam
