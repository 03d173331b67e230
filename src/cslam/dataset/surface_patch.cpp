// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/surface_patch.h"

#include <algorithm>
#include <cmath>

namespace cslam {
namespace {

constexpr double kMinDepthM = 0.05;  // nearer points are not projected

struct PlaneFit {
  Eigen::Vector3d inverse_depth = Eigen::Vector3d::Zero();  // per px in u, per px in v, at centre
  double max_error = 0.0;                                   // 1/m
};

// Least squares over the square around a pixel; nothing if a reading is missing.
std::optional<PlaneFit> FitPlane(const cv::Mat& inverse_depth, int x, int y, int window_px) {
  double sum = 0.0;
  double sum_u = 0.0;
  double sum_v = 0.0;
  double norm = 0.0;
  for (int v = -window_px; v <= window_px; ++v) {
    const auto* row = inverse_depth.ptr<float>(y + v);
    for (int u = -window_px; u <= window_px; ++u) {
      const auto inverse = static_cast<double>(row[x + u]);
      if (inverse == 0.0) return std::nullopt;
      sum += inverse;
      sum_u += u * inverse;
      sum_v += v * inverse;
      norm += u * u;
    }
  }
  const int side = 2 * window_px + 1;
  PlaneFit fit{.inverse_depth = {sum_u / norm, sum_v / norm, sum / (side * side)}, .max_error = 0};
  for (int v = -window_px; v <= window_px; ++v) {
    const auto* row = inverse_depth.ptr<float>(y + v);
    for (int u = -window_px; u <= window_px; ++u) {
      const double fitted = fit.inverse_depth.dot(Eigen::Vector3d(u, v, 1.0));
      fit.max_error = std::max(fit.max_error, std::abs(fitted - static_cast<double>(row[x + u])));
    }
  }
  return fit;
}

}  // namespace

SurfacePatches::SurfacePatches(const Camera& camera, const SurfacePatchOptions& options)
    : camera_(camera), options_(options) {
  rays_.reserve(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector2d raw(x, y);
      const Eigen::Vector2d ideal = camera.HasDistortion() ? Undistort(camera, raw) : raw;
      rays_.push_back(Unproject(camera, ideal, 1.0));
    }
  }
}

cv::Mat InverseDepth(const cv::Mat& depth_m) {
  cv::Mat inverse(depth_m.rows, depth_m.cols, CV_32FC1);
  for (int y = 0; y < depth_m.rows; ++y) {
    const auto* from = depth_m.ptr<float>(y);
    auto* to = inverse.ptr<float>(y);
    for (int x = 0; x < depth_m.cols; ++x)
      to[x] = from[x] > 0.0F ? 1.0F / from[x] : 0.0F;
  }
  return inverse;
}

bool SurfacePatches::IsFlat(const cv::Mat& inverse_depth, int x, int y) const {
  const int window_px = options_.window_px;
  if (x < window_px || y < window_px || x + window_px >= inverse_depth.cols ||
      y + window_px >= inverse_depth.rows) {
    return false;
  }
  const std::optional<PlaneFit> fit = FitPlane(inverse_depth, x, y, window_px);
  if (!fit) return false;
  const double z_m = 1.0 / static_cast<double>(inverse_depth.at<float>(y, x));
  if (fit->max_error * z_m * z_m > options_.tolerance.At(z_m)) return false;
  // The plane n . p = 1 has 1 / z = n . (p / z): its normal from the change of inverse depth.
  const Eigen::Vector3d& ray = Ray(x, y);
  const double a = fit->inverse_depth.x() * camera_.fx;
  const double b = fit->inverse_depth.y() * camera_.fy;
  const Eigen::Vector3d normal(a, b, fit->inverse_depth.z() - a * ray.x() - b * ray.y());
  return normal.dot(ray) > options_.min_cosine * normal.norm() * ray.norm();
}

std::optional<Eigen::Vector2d> SurfacePatches::RawPixel(const Eigen::Vector3d& p_camera) const {
  if (p_camera.z() < kMinDepthM) return std::nullopt;
  Eigen::Vector2d uv = Project(camera_, p_camera);
  const Eigen::Vector2d size(camera_.width, camera_.height);
  // Far outside, lens distortion folds back into the image.
  if ((uv.array() < -0.2 * size.array()).any() || (uv.array() > 1.2 * size.array()).any()) {
    return std::nullopt;
  }
  if (camera_.HasDistortion()) uv = Distort(camera_, uv);
  const bool is_inside = uv.x() >= 0.0 && uv.y() >= 0.0 && uv.x() < camera_.width - 1.0 &&
                         uv.y() < camera_.height - 1.0;
  if (!is_inside) return std::nullopt;
  return uv;
}

std::optional<double> SurfacePatches::DepthAt(const cv::Mat& inverse_depth,
                                              const Eigen::Vector2d& uv_px) const {
  const auto x = static_cast<int>(std::floor(uv_px.x()));
  const auto y = static_cast<int>(std::floor(uv_px.y()));
  const double du = uv_px.x() - x;
  const double dv = uv_px.y() - y;
  double inverse = 0.0;
  for (int v = 0; v <= 1; ++v) {
    for (int u = 0; u <= 1; ++u) {
      if (!IsFlat(inverse_depth, x + u, y + v)) return std::nullopt;
      const double weight = (u == 0 ? 1.0 - du : du) * (v == 0 ? 1.0 - dv : dv);
      inverse += weight * static_cast<double>(inverse_depth.at<float>(y + v, x + u));
    }
  }
  return 1.0 / inverse;
}

}  // namespace cslam
