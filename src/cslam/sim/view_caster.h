// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/geometry/se3.h"
#include "cslam/sim/facet.h"
#include "cslam/sim/moving_scene.h"
#include "cslam/sim/ray_scene.h"
#include "cslam/sim/resting_scene.h"
#include "cslam/sim/scene.h"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace cslam {

// The rays of one picture: what they meet and what that looks like from here.
class ViewCaster {
 public:
  // pixel_rays: camera frame, z = 1, row by row. Keeps references to all but the pose.
  ViewCaster(const Scene& scene, const RestingScene& resting, const MovingScene& moving,
             const Camera& camera, std::span<const Eigen::Vector3f> pixel_rays,
             const Se3& T_world_camera);

  // The world ray (z = 1 in the camera) through a pixel, shifted by (du, dv) px.
  Eigen::Vector3f RayOf(std::size_t pixel, float du = 0.0F, float dv = 0.0F) const {
    return R_world_camera_ * pixel_rays_[pixel] + du * step_x_ + dv * step_y_;
  }

  // One hit per ray; pixels[i] is the pixel that rays[i] goes through.
  std::vector<RayHit> Cast(std::span<const Eigen::Vector3f> rays,
                           std::span<const std::size_t> pixels) const;

  // Display colour, 0 to 255; black where there is nothing.
  Eigen::Array3f Shade(const RayHit& hit, const Eigen::Vector3f& ray) const;

  // z depth (m). Not taken from Embree, whose reciprocals are approximate and differ between
  // processors.
  double DepthOf(const RayHit& hit, const Eigen::Vector3f& ray) const {
    return DepthTo(FacetOf(hit), ray);
  }

  bool IsMoving(const RayHit& hit) const { return moving_.facets().Has(hit.object); }

  // Whether two neighbours show different faces, so that a pixel may need more than one ray.
  bool Differ(const RayHit& a, const RayHit& b) const;

 private:
  const Facet& FacetOf(const RayHit& hit) const {
    return IsMoving(hit) ? moving_.facets().At(hit) : resting_.facets().At(hit);
  }
  double DepthTo(const Facet& facet, const Eigen::Vector3f& ray) const;
  void MarkPixelsOf(const PlacedObject& mover, const Camera& camera, const Se3& T_camera_world);

  const Scene& scene_;
  const RestingScene& resting_;
  const MovingScene& moving_;
  std::span<const Eigen::Vector3f> pixel_rays_;
  Eigen::Vector3d origin_;  // m, world
  Eigen::Matrix3f R_world_camera_;
  Eigen::Vector3f step_x_;  // change of a ray from one pixel to the next, world
  Eigen::Vector3f step_y_;
  std::vector<char> may_show_mover_;  // per pixel; empty if nothing moves
};

}  // namespace cslam
