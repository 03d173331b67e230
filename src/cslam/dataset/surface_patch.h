// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/check_frames.h"
#include "cslam/geometry/camera.h"

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include <optional>
#include <vector>

namespace cslam {

struct SurfacePatchOptions {
  int window_px = 1;  // half the side of the square that must be flat
  double min_cosine = 0.25;
  DepthTolerance tolerance;  // largest distance from the fitted plane
};

// H x W, CV_32FC1, 1/m; 0 where there is no reading.
cv::Mat InverseDepth(const cv::Mat& depth_m);

// Reads images of inverse depth where they show flat, well-seen surfaces: there it is linear in
// the pixel, and can be interpolated. Knows the ray of every pixel, lens distortion included.
class SurfacePatches {
 public:
  SurfacePatches(const Camera& camera, const SurfacePatchOptions& options);

  // Camera frame, z = 1.
  const Eigen::Vector3d& Ray(int x, int y) const {
    return rays_[static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width) +
                 static_cast<std::size_t>(x)];
  }

  // Whether all readings around the pixel lie on one plane, which is not seen too flat.
  bool IsFlat(const cv::Mat& inverse_depth, int x, int y) const;

  // Where a point in the camera frame is seen in the image as it is, with a neighbour on each side.
  std::optional<Eigen::Vector2d> RawPixel(const Eigen::Vector3d& p_camera) const;

  // Depth (m) between four pixels that are flat.
  std::optional<double> DepthAt(const cv::Mat& inverse_depth, const Eigen::Vector2d& uv_px) const;

 private:
  Camera camera_;
  SurfacePatchOptions options_;
  std::vector<Eigen::Vector3d> rays_;  // row by row
};

}  // namespace cslam
