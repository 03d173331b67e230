// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/map/map_view.h"

#include <Eigen/Core>
#include <opencv2/core/types.hpp>

#include <optional>
#include <vector>

namespace cslam {

// The directions of the pixels of a reduced depth image, at depth 1 m, camera frame.
class DepthRays {
 public:
  DepthRays(const Camera& camera, const cv::Size& size);

  const cv::Size& size() const { return size_; }
  const Eigen::Vector3d& At(int u, int v) const {
    return rays_[static_cast<std::size_t>(v * size_.width + u)];
  }

 private:
  cv::Size size_;
  std::vector<Eigen::Vector3d> rays_;
};

// The alive keyframes of one map that have depth, by id; all of one size.
std::vector<const Keyframe*> KeyframesWithDepth(const MapView& map, MapId map_id);

// One surface element that a keyframe saw, in the world.
struct SurfaceElement {
  Eigen::Vector3d p_world;
  Eigen::Vector3d normal_world;  // towards the camera
  double area_m2 = 0.0;          // about; far pixels cover more
};

// Surface elements on a lattice of every step-th pixel, where depth is smooth and not beyond
// max_depth_m.
std::vector<SurfaceElement> SurfaceElements(const Keyframe& keyframe, const DepthRays& rays,
                                            int step, double max_depth_m);

}  // namespace cslam
