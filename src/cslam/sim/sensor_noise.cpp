// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/sensor_noise.h"

#include "cslam/sim/noise_fields.h"
#include "cslam/util/check.h"
#include "cslam/util/quantile.h"

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace cslam {
namespace {

// Marks (non-zero) pixels at most reach_px from a depth step.
cv::Mat DepthSteps(const cv::Mat& depth_m, double step, double reach_px) {
  cv::Mat steps = cv::Mat::zeros(depth_m.size(), CV_8UC1);
  const auto ratio = static_cast<float>(1.0 + step);
  const auto is_step = [&](float a, float b) { return a > ratio * b || b > ratio * a; };
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      const float z = depth_m.at<float>(v, u);
      const bool right = u + 1 < depth_m.cols && is_step(z, depth_m.at<float>(v, u + 1));
      const bool below = v + 1 < depth_m.rows && is_step(z, depth_m.at<float>(v + 1, u));
      if (right || below) steps.at<unsigned char>(v, u) = 1;
      if (right) steps.at<unsigned char>(v, u + 1) = 1;
      if (below) steps.at<unsigned char>(v + 1, u) = 1;
    }
  }
  const int radius = static_cast<int>(std::lround(reach_px)) - 1;
  if (radius <= 0) return steps;
  cv::Mat wide;
  cv::dilate(steps, wide,
             cv::getStructuringElement(cv::MORPH_RECT, {2 * radius + 1, 2 * radius + 1}));
  return wide;
}

// Decides which pixels at depth steps give nothing: each by itself, or whole patches.
class EdgeDropout {
 public:
  EdgeDropout(cv::Size size, const DepthNoiseOptions& options, Rng rng)
      : rng_(rng), chance_(options.edge_dropout) {
    if (options.dropout_patch_px <= 0.0) return;
    const double spacing_px = std::max(1.0, options.dropout_patch_px * size.width / 640.0);
    field_ = SmoothNormal(size, spacing_px, Rng(rng.NextUint64()));
    const auto values = std::vector<float>(field_.begin<float>(), field_.end<float>());
    threshold_ = QuantileOf(values, chance_);
  }

  // In order of pixels.
  bool Takes(int v, int u) {
    return field_.empty() ? rng_.Uniform() < chance_ : field_.at<float>(v, u) < threshold_;
  }

 private:
  Rng rng_;
  double chance_;
  cv::Mat field_;
  float threshold_ = 0.0F;
};

// The neighbour at p + step or p - step, whichever is nearer in depth: that across a depth step
// belongs to another surface.
cv::Point SameSurface(const cv::Mat& depth_m, cv::Point p, cv::Point step) {
  const auto jump = [&](cv::Point q) {
    const bool inside = q.x >= 0 && q.y >= 0 && q.x < depth_m.cols && q.y < depth_m.rows;
    return inside ? std::abs(depth_m.at<float>(q) - depth_m.at<float>(p)) : 1e9F;
  };
  return jump(p + step) < jump(p - step) ? p + step : p - step;
}

// Squared cosine between the line of sight and the surface normal, from depth differences.
double SquaredCosine(const cv::Mat& depth_m, const Camera& camera, cv::Point pixel) {
  const auto point = [&](cv::Point p) {
    return Unproject(camera, {static_cast<double>(p.x), static_cast<double>(p.y)},
                     static_cast<double>(depth_m.at<float>(p)));
  };
  const Eigen::Vector3d p = point(pixel);
  const Eigen::Vector3d across = point(SameSurface(depth_m, pixel, {1, 0})) - p;
  const Eigen::Vector3d down = point(SameSurface(depth_m, pixel, {0, 1})) - p;
  const Eigen::Vector3d normal = across.cross(down);
  const double dot = normal.dot(p);
  const double norms = normal.squaredNorm() * p.squaredNorm();
  return norms > 0.0 ? dot * dot / norms : 1.0;
}

// Which pixels of a row the projector, to the right of the camera, lights: scanning from the
// right, a pixel whose place in the projector's image was passed by a nearer one lies in shadow.
std::vector<bool> LitPixels(const float* depth_m, int width, double focal_baseline_px_m) {
  constexpr double kSlackPx = 0.5;
  std::vector<bool> lit(static_cast<std::size_t>(width), true);
  double leftmost_px = 1e9;
  for (int u = width - 1; u >= 0; --u) {
    if (depth_m[u] <= 0.0F) continue;
    const double projector_px = u - focal_baseline_px_m / static_cast<double>(depth_m[u]);
    lit[static_cast<std::size_t>(u)] = projector_px <= leftmost_px + kSlackPx;
    leftmost_px = std::min(leftmost_px, projector_px);
  }
  return lit;
}

}  // namespace

DepthNoiseOptions D435iDepthNoise() {
  return {.baseline_m = 0.05,
          .disparity_sigma_px = 0.005,
          .patch_sigma_px = 0.08,
          .patch_size_px = 14.0,
          .quantum_px = 1.0 / 16.0,
          .unit_m = 0.001,
          .min_depth_m = 0.3,
          .max_depth_m = 6.0,
          .edge_dropout = 0.8,
          .edge_reach_px = 3.0,
          .dropout_patch_px = 4.0,
          .edge_step = 0.04,
          .grazing_cosine = 0.12};
}

cv::Mat AddDepthNoise(const cv::Mat& depth_m, const Camera& camera,
                      const DepthNoiseOptions& options, std::uint64_t seed, std::uint64_t frame) {
  CSLAM_CHECK(depth_m.type() == CV_32FC1);
  const NormalTable normal(MakeNoiseRng(seed, frame, NoisePurpose::kTable));
  Rng pixel_rng = MakeNoiseRng(seed, frame, NoisePurpose::kPixels);
  EdgeDropout dropout(depth_m.size(), options, MakeNoiseRng(seed, frame, NoisePurpose::kDropout));
  const double width_ratio = 640.0 / depth_m.cols;
  const cv::Mat patches = SmoothNormal(depth_m.size(), options.patch_size_px / width_ratio,
                                       MakeNoiseRng(seed, frame, NoisePurpose::kPatches));
  const cv::Mat steps = DepthSteps(depth_m, options.edge_step, options.edge_reach_px / width_ratio);
  const double focal_baseline = camera.fx * options.baseline_m;
  const double disparity_scale = focal_baseline * width_ratio;
  const double min_cosine2 = options.grazing_cosine * options.grazing_cosine;
  cv::Mat noisy = cv::Mat::zeros(depth_m.size(), CV_32FC1);
  for (int v = 0; v < depth_m.rows; ++v) {
    const auto* row_m = depth_m.ptr<float>(v);
    const std::vector<bool> lit = LitPixels(row_m, depth_m.cols, focal_baseline);
    for (int u = 0; u < depth_m.cols; ++u) {
      const double error_px =
          options.disparity_sigma_px * static_cast<double>(normal.At(pixel_rng.NextUint64())) +
          options.patch_sigma_px * static_cast<double>(patches.at<float>(v, u));
      const auto z = static_cast<double>(row_m[u]);
      if (z < options.min_depth_m || z > options.max_depth_m) continue;
      if (!lit[static_cast<std::size_t>(u)]) continue;
      if (steps.at<unsigned char>(v, u) != 0 && dropout.Takes(v, u)) continue;
      if (SquaredCosine(depth_m, camera, {u, v}) < min_cosine2) continue;
      const double measured_px = disparity_scale / z + error_px;
      const double quantised_px =
          options.quantum_px > 0.0
              ? options.quantum_px * std::round(measured_px / options.quantum_px)
              : measured_px;
      if (quantised_px <= 0.0) continue;
      const double seen_m = disparity_scale / quantised_px;
      noisy.at<float>(v, u) = static_cast<float>(
          options.unit_m > 0.0 ? options.unit_m * std::round(seen_m / options.unit_m) : seen_m);
    }
  }
  return noisy;
}

}  // namespace cslam
