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
  double max_error_m = 0.0;
};

// Least squares of inverse depth over the square around a pixel; nothing if a reading is missing.
std::optional<PlaneFit> FitPlane(const cv::Mat& depth_m, int x, int y, int window_px) {
  double sum = 0.0;
  double sum_u = 0.0;
  double sum_v = 0.0;
  double norm = 0.0;
  for (int v = -window_px; v <= window_px; ++v) {
    const auto* row = depth_m.ptr<float>(y + v);
    for (int u = -window_px; u <= window_px; ++u) {
      const auto z_m = static_cast<double>(row[x + u]);
      if (!(z_m > 0.0)) return std::nullopt;
      sum += 1.0 / z_m;
      sum_u += u / z_m;
      sum_v += v / z_m;
      norm += u * u;
    }
  }
  const int side = 2 * window_px + 1;
  PlaneFit fit{.inverse_depth = {sum_u / norm, sum_v / norm, sum / (side * side)},
               .max_error_m = 0};
  for (int v = -window_px; v <= window_px; ++v) {
    const auto* row = depth_m.ptr<float>(y + v);
    for (int u = -window_px; u <= window_px; ++u) {
      const double inverse = fit.inverse_depth.dot(Eigen::Vector3d(u, v, 1.0));
      if (!(inverse > 0.0)) return std::nullopt;
      fit.max_error_m =
          std::max(fit.max_error_m, std::abs(1.0 / inverse - static_cast<double>(row[x + u])));
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

bool SurfacePatches::IsFlat(const cv::Mat& depth_m, int x, int y) const {
  const int window_px = options_.window_px;
  if (x < window_px || y < window_px || x + window_px >= depth_m.cols ||
      y + window_px >= depth_m.rows) {
    return false;
  }
  const std::optional<PlaneFit> fit = FitPlane(depth_m, x, y, window_px);
  if (!fit) return false;
  if (fit->max_error_m > options_.tolerance.At(static_cast<double>(depth_m.at<float>(y, x)))) {
    return false;
  }
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

std::optional<double> SurfacePatches::DepthAt(const cv::Mat& depth_m,
                                              const Eigen::Vector2d& uv_px) const {
  const auto x = static_cast<int>(std::floor(uv_px.x()));
  const auto y = static_cast<int>(std::floor(uv_px.y()));
  const double du = uv_px.x() - x;
  const double dv = uv_px.y() - y;
  double inverse = 0.0;
  for (int v = 0; v <= 1; ++v) {
    for (int u = 0; u <= 1; ++u) {
      if (!IsFlat(depth_m, x + u, y + v)) return std::nullopt;
      const double weight = (u == 0 ? 1.0 - du : du) * (v == 0 ? 1.0 - dv : dv);
      inverse += weight / static_cast<double>(depth_m.at<float>(y + v, x + u));
    }
  }
  return 1.0 / inverse;
}

}  // namespace cslam
