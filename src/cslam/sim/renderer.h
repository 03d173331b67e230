// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/geometry/se3.h"
#include "cslam/sim/lighting.h"
#include "cslam/sim/ray_scene.h"
#include "cslam/sim/scene.h"
#include "cslam/sim/world.h"

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace cslam {

// One exact view. All images H x W.
struct RenderedView {
  cv::Mat bgr;        // CV_8UC3
  cv::Mat depth_m;    // CV_32FC1, along z at the pixel's centre; 0 where there is nothing
  cv::Mat instances;  // CV_16UC1, index into Scene::objects; 0 (the room) where there is nothing
};

// Turns a scene into images by casting one ray per pixel, and a few more where objects meet.
// The result depends on scene, camera and pose alone. Const: one renderer serves many threads.
class Renderer {
 public:
  Renderer(World world, const Camera& camera);
  Renderer(Scene scene, const Camera& camera);

  RenderedView Render(const Se3& T_world_camera, double time_s = 0.0) const;

  const World& world() const { return world_; }
  const Camera& camera() const { return camera_; }

 private:
  // A triangle ready for shading: everything on it is affine in the world point p.
  struct Facet {
    Eigen::Vector3f p0;               // m, world
    Eigen::Vector3f normal;           // unit, world
    Eigen::Vector2f uv0;              // texture periods at p0
    Eigen::Matrix<float, 2, 3> d_uv;  // change of uv with p, per m
    Eigen::Vector3f d_gain;           // change of the light factor with p, per m
    float gain0 = 1.0F;               // light factor at p0
    int texture = 0;
  };
  struct ViewPoint;

  void MakeFacets(const VertexGains& gains);
  const Facet& FacetOf(const RayHit& hit) const {
    return facets_[first_facet_[hit.object] + hit.triangle];
  }
  Eigen::Array3f Shade(const ViewPoint& view, const RayHit& hit,
                       const Eigen::Vector3f& ray_world) const;
  std::vector<std::size_t> EdgePixels(std::span<const RayHit> hits) const;
  void SmoothEdges(const ViewPoint& view, std::span<const RayHit> hits, cv::Mat bgr) const;

  World world_;
  Camera camera_;
  RayScene rays_;
  std::vector<Facet> facets_;                // of all objects, one after the other
  std::vector<std::size_t> first_facet_;     // per object
  std::vector<Eigen::Vector3f> pixel_rays_;  // camera frame, z = 1, row by row
};

}  // namespace cslam
