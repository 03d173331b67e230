// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/objects/depth_region.h"

#include <opencv2/core/mat.hpp>

#include <algorithm>
#include <cmath>

namespace cslam::test {

// Depth images of boxes before a wall, drawn without a renderer.
inline Camera SceneCamera() {
  Camera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 525.0;
  camera.cx = 319.5;
  camera.cy = 239.5;
  return camera;
}

// A wall that fills the picture.
inline cv::Mat Wall(double depth_m) {
  return cv::Mat(480, 640, CV_32FC1, cv::Scalar(depth_m));
}

// An upright panel whose centre is at (x, y) (m, camera frame) and whose front is at depth_m.
inline Box DrawPanel(cv::Mat& depth_m, double x, double y, double depth, double width,
                     double height) {
  const Camera camera = SceneCamera();
  const auto u = [&](double metres) { return camera.cx + camera.fx * metres / depth; };
  const auto v = [&](double metres) { return camera.cy + camera.fy * metres / depth; };
  const int u0 = std::clamp(static_cast<int>(std::lround(u(x - width / 2))), 0, depth_m.cols);
  const int u1 = std::clamp(static_cast<int>(std::lround(u(x + width / 2))), 0, depth_m.cols);
  const int v0 = std::clamp(static_cast<int>(std::lround(v(y - height / 2))), 0, depth_m.rows);
  const int v1 = std::clamp(static_cast<int>(std::lround(v(y + height / 2))), 0, depth_m.rows);
  for (int row = v0; row < v1; ++row) {
    for (int column = u0; column < u1; ++column) {
      float& pixel = depth_m.at<float>(row, column);
      pixel = std::min(pixel, static_cast<float>(depth));
    }
  }
  return {static_cast<double>(u0), static_cast<double>(v0), static_cast<double>(u1),
          static_cast<double>(v1)};
}

inline DepthView ViewOf(const cv::Mat& depth_m) {
  return DepthViewMaker(SceneCamera()).Make(depth_m);
}

inline cv::Rect ThumbnailOf(const Box& box, int step) {
  return {static_cast<int>(box.x_min) / step, static_cast<int>(box.y_min) / step,
          static_cast<int>(box.width()) / step, static_cast<int>(box.height()) / step};
}

// Share of the box's thumbnail pixels that the region covers.
inline double Coverage(const DepthRegion& region, const Box& box, int step) {
  int inside = 0;
  int covered = 0;
  for (int v = 0; v < region.mask.rows; ++v) {
    for (int u = 0; u < region.mask.cols; ++u) {
      if (!box.Contains(u * step + step / 2, v * step + step / 2)) continue;
      ++inside;
      covered += region.mask.at<std::uint8_t>(v, u) != 0 ? 1 : 0;
    }
  }
  return inside == 0 ? 0.0 : static_cast<double>(covered) / inside;
}

}  // namespace cslam::test
