// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"

#include <Eigen/Core>
#include <opencv2/core/types.hpp>

#include <vector>

namespace cslam {

// For each pixel of a reduced depth image of a camera the point at depth 1 m, camera frame.
class PixelRays {
 public:
  PixelRays(const Camera& camera, const cv::Size& size);

  const cv::Size& size() const { return size_; }
  const Eigen::Vector3d& At(int u, int v) const {
    return rays_[static_cast<std::size_t>(v * size_.width + u)];
  }

 private:
  cv::Size size_;
  std::vector<Eigen::Vector3d> rays_;
};

}  // namespace cslam
