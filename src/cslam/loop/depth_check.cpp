// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/depth_check.h"

#include "cslam/vision/depth_thumbnail.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace cslam {
namespace {

constexpr int kStride = 2;  // every other pixel of every other row is plenty

// Lines of sight of the pixels of a thumbnail, with z = 1, row by row.
class ThumbnailRays {
 public:
  ThumbnailRays(const Camera& camera, const cv::Size& size)
      : camera_(camera), step_(DepthThumbnailStep(camera.width)), size_(size) {
    rays_.reserve(static_cast<std::size_t>(size.area()));
    for (int v = 0; v < size.height; ++v) {
      for (int u = 0; u < size.width; ++u) {
        const Eigen::Vector2d raw(u * step_ + step_ / 2, v * step_ + step_ / 2);
        const Eigen::Vector2d uv = camera.HasDistortion() ? Undistort(camera, raw) : raw;
        rays_.push_back(Unproject(camera, uv, 1.0));
      }
    }
  }

  const Eigen::Vector3d& ray(int u, int v) const {
    return rays_[static_cast<std::size_t>(v * size_.width + u)];
  }

  // The thumbnail's pixel that shows a point in front of the camera; outside of it if there is
  // none.
  cv::Point PixelOf(const Eigen::Vector3d& p_camera) const {
    const Eigen::Vector2d uv = Project(camera_, p_camera);
    const Eigen::Vector2d raw = camera_.HasDistortion() ? Distort(camera_, uv) : uv;
    const double limit = 2.0 * camera_.width;  // far outside, where numbers may be anything
    if (!(raw.cwiseAbs().maxCoeff() < limit)) return {-1, -1};
    return {static_cast<int>(std::floor((raw.x() - step_ / 2) / step_ + 0.5)),
            static_cast<int>(std::floor((raw.y() - step_ / 2) / step_ + 0.5))};
  }

  const cv::Size& size() const { return size_; }

 private:
  Camera camera_;
  int step_;
  cv::Size size_;
  std::vector<Eigen::Vector3d> rays_;
};

struct DepthRange {
  double min_m = std::numeric_limits<double>::infinity();
  double max_m = 0.0;

  bool is_empty() const { return max_m == 0.0; }
};

// Over a pixel and those around it, so that edges contradict nothing.
DepthRange RangeAround(const cv::Mat& depth_mm, const cv::Point& pixel) {
  DepthRange range;
  for (int v = std::max(0, pixel.y - 1); v <= std::min(depth_mm.rows - 1, pixel.y + 1); ++v) {
    const auto* row = depth_mm.ptr<std::uint16_t>(v);
    for (int u = std::max(0, pixel.x - 1); u <= std::min(depth_mm.cols - 1, pixel.x + 1); ++u) {
      if (row[u] == 0) continue;
      range.min_m = std::min(range.min_m, 1e-3 * row[u]);
      range.max_m = std::max(range.max_m, 1e-3 * row[u]);
    }
  }
  return range;
}

void Compare(const PlacedDepth& from, const PlacedDepth& into, const ThumbnailRays& rays,
             const DepthCheckOptions& options, DepthComparison& result) {
  const Se3 T_into_from = into.T_world_camera.Inverse() * from.T_world_camera;
  const Eigen::Matrix3d R_into_from = T_into_from.R();
  const cv::Rect image({0, 0}, rays.size());
  for (int v = 0; v < rays.size().height; v += kStride) {
    const auto* row = from.depth_small_mm.ptr<std::uint16_t>(v);
    for (int u = 0; u < rays.size().width; u += kStride) {
      if (row[u] == 0) continue;
      const Eigen::Vector3d p =
          1e-3 * row[u] * (R_into_from * rays.ray(u, v)) + T_into_from.translation;
      if (p.z() < 0.1) continue;  // beside or behind the camera
      const cv::Point pixel = rays.PixelOf(p);
      if (!image.contains(pixel)) continue;
      const DepthRange seen = RangeAround(into.depth_small_mm, pixel);
      if (seen.is_empty()) continue;
      const double tolerance =
          options.tolerance_m + options.tolerance_per_m2 * seen.min_m * seen.min_m;
      if (p.z() < seen.min_m - tolerance) {
        ++result.num_contradicting;
      } else if (p.z() <= seen.max_m + tolerance) {
        ++result.num_agreeing;
      }
    }
  }
}

}  // namespace

DepthComparison CompareDepth(const std::vector<PlacedDepth>& side_a,
                             const std::vector<PlacedDepth>& side_b, const Camera& camera,
                             const DepthCheckOptions& options) {
  DepthComparison result;
  std::vector<const PlacedDepth*> views;
  for (const auto* side : {&side_a, &side_b}) {
    for (const PlacedDepth& view : *side) {
      if (!view.depth_small_mm.empty()) views.push_back(&view);
    }
  }
  if (views.empty()) return result;
  const ThumbnailRays rays(camera, views.front()->depth_small_mm.size());
  for (const PlacedDepth& a : side_a) {
    for (const PlacedDepth& b : side_b) {
      if (a.depth_small_mm.size() != rays.size() || b.depth_small_mm.size() != rays.size())
        continue;
      Compare(a, b, rays, options, result);
      Compare(b, a, rays, options, result);
    }
  }
  return result;
}

std::string WhyContradicted(const DepthComparison& depth, const DepthCheckOptions& options) {
  if (depth.num_compared() < options.min_compared) {
    return fmt::format("only {} depth readings can be compared", depth.num_compared());
  }
  if (depth.contradicted() > options.max_contradicted) {
    return fmt::format("{:.0f} % of the depth contradicts it > {:.0f} %",
                       100.0 * depth.contradicted(), 100.0 * options.max_contradicted);
  }
  return {};
}

}  // namespace cslam
