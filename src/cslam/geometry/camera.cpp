// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/geometry/camera.h"

#include <Eigen/LU>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace cslam {
namespace {

struct Distorted {
  Eigen::Vector2d xy;
  Eigen::Matrix2d jacobian;  // d(xy) / d(ideal x, y)
};

// Brown-Conrady on normalised coordinates.
Distorted DistortNormalised(const Camera& c, const Eigen::Vector2d& ideal) {
  const double x = ideal.x();
  const double y = ideal.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3));
  const double radial_dr2 = c.k1 + r2 * (2.0 * c.k2 + 3.0 * c.k3 * r2);
  Distorted d;
  d.xy = {x * radial + 2.0 * c.p1 * x * y + c.p2 * (r2 + 2.0 * x * x),
          y * radial + c.p1 * (r2 + 2.0 * y * y) + 2.0 * c.p2 * x * y};
  d.jacobian << radial + 2.0 * x * x * radial_dr2 + 2.0 * c.p1 * y + 6.0 * c.p2 * x,
      2.0 * x * y * radial_dr2 + 2.0 * c.p1 * x + 2.0 * c.p2 * y,
      2.0 * x * y * radial_dr2 + 2.0 * c.p1 * x + 2.0 * c.p2 * y,
      radial + 2.0 * y * y * radial_dr2 + 6.0 * c.p1 * y + 2.0 * c.p2 * x;
  return d;
}

Eigen::Vector2d Normalise(const Camera& c, const Eigen::Vector2d& px) {
  return {(px.x() - c.cx) / c.fx, (px.y() - c.cy) / c.fy};
}

Eigen::Vector2d ToPixel(const Camera& c, const Eigen::Vector2d& xy) {
  return {c.fx * xy.x() + c.cx, c.fy * xy.y() + c.cy};
}

}  // namespace

std::string WhyInvalid(const Camera& c) {
  const std::array values{c.fx, c.fy, c.cx, c.cy, c.k1, c.k2, c.p1, c.p2, c.k3};
  if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); })) {
    return "an intrinsic or distortion value is not a finite number";
  }
  if (c.width < 32 || c.height < 32 || c.width > 16384 || c.height > 16384) {
    return fmt::format("image size {}x{} is outside 32 to 16384", c.width, c.height);
  }
  if (c.fx <= 0.0 || c.fy <= 0.0) {
    return fmt::format("focal lengths must be positive (fx {}, fy {})", c.fx, c.fy);
  }
  if (c.cx < 0.0 || c.cx > c.width || c.cy < 0.0 || c.cy > c.height) {
    return fmt::format("principal point ({}, {}) lies outside the {}x{} image", c.cx, c.cy, c.width,
                       c.height);
  }
  return {};
}

Eigen::Vector2d Distort(const Camera& camera, const Eigen::Vector2d& undistorted_px) {
  if (!camera.HasDistortion()) return undistorted_px;
  return ToPixel(camera, DistortNormalised(camera, Normalise(camera, undistorted_px)).xy);
}

Eigen::Vector2d Undistort(const Camera& camera, const Eigen::Vector2d& raw_px) {
  if (!camera.HasDistortion()) return raw_px;
  constexpr int kMaxIterations = 10;
  constexpr double kConverged = 1e-18;  // squared, in normalised coordinates
  const Eigen::Vector2d target = Normalise(camera, raw_px);
  Eigen::Vector2d ideal = target;
  for (int i = 0; i < kMaxIterations; ++i) {
    const Distorted d = DistortNormalised(camera, ideal);
    const Eigen::Vector2d error = d.xy - target;
    if (error.squaredNorm() < kConverged) break;
    if (std::abs(d.jacobian.determinant()) < 1e-6) break;  // beyond the model's fold: best so far
    ideal -= d.jacobian.inverse() * error;
  }
  return ToPixel(camera, ideal);
}

ImageBounds UndistortedBounds(const Camera& camera) {
  constexpr int kSteps = 32;
  ImageBounds b{1e9, -1e9, 1e9, -1e9};
  const auto extend = [&](double u, double v) {
    const Eigen::Vector2d px = Undistort(camera, {u, v});
    b.min_u = std::min(b.min_u, px.x());
    b.max_u = std::max(b.max_u, px.x());
    b.min_v = std::min(b.min_v, px.y());
    b.max_v = std::max(b.max_v, px.y());
  };
  for (int i = 0; i <= kSteps; ++i) {
    const double u = static_cast<double>(camera.width) * i / kSteps;
    const double v = static_cast<double>(camera.height) * i / kSteps;
    extend(u, 0.0);
    extend(u, camera.height);
    extend(0.0, v);
    extend(camera.width, v);
  }
  return b;
}

}  // namespace cslam
