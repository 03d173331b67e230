// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/vision/pixel_rays.h"

namespace cslam {

PixelRays::PixelRays(const Camera& camera, const cv::Size& size) : size_(size) {
  const int step = camera.width / size.width;
  rays_.reserve(static_cast<std::size_t>(size.area()));
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const Eigen::Vector2d raw_px(u * step + step / 2, v * step + step / 2);
      rays_.push_back(Unproject(camera, Undistort(camera, raw_px), 1.0));
    }
  }
}

}  // namespace cslam
