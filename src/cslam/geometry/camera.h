// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <string>

namespace cslam {

// A pinhole camera with Brown-Conrady distortion (OpenCV's order k1 k2 p1 p2 k3).
// Pixel coordinates: u right, v down, (0, 0) the centre of the top left pixel.
// Camera frame: x right, y down, z forward, metres.
struct Camera {
  int width = 640;
  int height = 480;
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  // px
  double k1 = 0.0, k2 = 0.0, p1 = 0.0, p2 = 0.0, k3 = 0.0;

  bool HasDistortion() const {
    return k1 != 0.0 || k2 != 0.0 || p1 != 0.0 || p2 != 0.0 || k3 != 0.0;
  }
  bool operator==(const Camera&) const = default;
};

// Empty if the camera can be used; otherwise one sentence that says what is wrong.
std::string WhyInvalid(const Camera& camera);

// Undistorted pixel of a point in the camera frame; the caller has checked z > 0.
inline Eigen::Vector2d Project(const Camera& camera, const Eigen::Vector3d& p_camera) {
  const double inverse_z = 1.0 / p_camera.z();
  return {camera.fx * p_camera.x() * inverse_z + camera.cx,
          camera.fy * p_camera.y() * inverse_z + camera.cy};
}

// Point in the camera frame seen at an undistorted pixel with depth z (m).
inline Eigen::Vector3d Unproject(const Camera& camera, const Eigen::Vector2d& uv_px, double z) {
  return {(uv_px.x() - camera.cx) / camera.fx * z, (uv_px.y() - camera.cy) / camera.fy * z, z};
}

// Where the lens puts an ideal (undistorted) pixel in the raw image.
Eigen::Vector2d Distort(const Camera& camera, const Eigen::Vector2d& undistorted_px);

// Inverse of Distort() (Newton); accurate to 1e-6 px inside the image.
Eigen::Vector2d Undistort(const Camera& camera, const Eigen::Vector2d& raw_px);

// The rectangle that holds every undistorted pixel of the image.
struct ImageBounds {
  double min_u = 0.0, max_u = 0.0, min_v = 0.0, max_v = 0.0;  // px

  bool Contains(const Eigen::Vector2d& uv) const {
    return uv.x() >= min_u && uv.x() < max_u && uv.y() >= min_v && uv.y() < max_v;
  }
};
ImageBounds UndistortedBounds(const Camera& camera);

}  // namespace cslam
