// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/sensor_noise.h"

#include "cslam/util/check.h"
#include "cslam/util/random.h"

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace cslam {
namespace {

enum class Purpose : std::uint64_t {
  kTable = 11,
  kPixels = 12,
  kPatches = 13,
  kDropout = 14,
  kColor = 15
};

Rng MakeRng(std::uint64_t seed, std::uint64_t frame, Purpose purpose) {
  return Rng(seed, frame, static_cast<std::uint64_t>(purpose));
}

// Standard normal values drawn once per image and read from random places after: Box-Muller for
// every value would cost more than rendering.
class NormalTable {
 public:
  explicit NormalTable(Rng rng) {
    for (float& value : values_)
      value = static_cast<float>(rng.Gaussian());
  }

  float At(std::uint64_t bits) const { return values_[bits % kSize]; }

 private:
  static constexpr std::size_t kSize = 4096;
  std::array<float, kSize> values_{};
};

// H x W, CV_32FC1: standard normal on a grid of the given spacing, smooth in between.
cv::Mat SmoothNormal(cv::Size size, double spacing_px, Rng rng) {
  const auto cells = [&](int length) {
    return static_cast<int>(std::ceil(length / spacing_px)) + 2;
  };
  cv::Mat grid(cells(size.height), cells(size.width), CV_32FC1);
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.cols; ++c)
      grid.at<float>(r, c) = static_cast<float>(rng.Gaussian());
  }
  cv::Mat smooth;
  cv::resize(grid, smooth, size, 0.0, 0.0, cv::INTER_CUBIC);
  return smooth;
}

// Marks (non-zero) pixels behind a depth step, or next to one.
cv::Mat DepthSteps(const cv::Mat& depth_m, double step) {
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
  return steps;
}

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

cv::Mat AddDepthNoise(const cv::Mat& depth_m, const Camera& camera,
                      const DepthNoiseOptions& options, std::uint64_t seed, std::uint64_t frame) {
  CSLAM_CHECK(depth_m.type() == CV_32FC1);
  const NormalTable normal(MakeRng(seed, frame, Purpose::kTable));
  Rng pixel_rng = MakeRng(seed, frame, Purpose::kPixels);
  Rng dropout_rng = MakeRng(seed, frame, Purpose::kDropout);
  const double width_ratio = 640.0 / depth_m.cols;
  const cv::Mat patches = SmoothNormal(depth_m.size(), options.patch_size_px / width_ratio,
                                       MakeRng(seed, frame, Purpose::kPatches));
  const cv::Mat steps = DepthSteps(depth_m, options.edge_step);
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
      if (steps.at<unsigned char>(v, u) != 0 && dropout_rng.Uniform() < options.edge_dropout) {
        continue;
      }
      if (SquaredCosine(depth_m, camera, {u, v}) < min_cosine2) continue;
      const double measured_px = disparity_scale / z + error_px;
      const double quantised_px =
          options.quantum_px > 0.0
              ? options.quantum_px * std::round(measured_px / options.quantum_px)
              : measured_px;
      if (quantised_px > 0.0) {
        noisy.at<float>(v, u) = static_cast<float>(disparity_scale / quantised_px);
      }
    }
  }
  return noisy;
}

cv::Mat AddColorNoise(const cv::Mat& bgr, const ColorNoiseOptions& options, std::uint64_t seed,
                      std::uint64_t frame) {
  CSLAM_CHECK(bgr.type() == CV_8UC3);
  const NormalTable normal(MakeRng(seed, frame, Purpose::kTable));
  Rng rng = MakeRng(seed, frame, Purpose::kColor);
  const auto sigma = static_cast<float>(options.sigma);
  const auto vignetting = static_cast<float>(options.vignetting);
  const float centre_u = 0.5F * static_cast<float>(bgr.cols);
  const float centre_v = 0.5F * static_cast<float>(bgr.rows);
  const float corner2 = centre_u * centre_u + centre_v * centre_v;
  cv::Mat noisy(bgr.size(), CV_8UC3);
  for (int v = 0; v < bgr.rows; ++v) {
    const auto* from = bgr.ptr<cv::Vec3b>(v);
    auto* to = noisy.ptr<cv::Vec3b>(v);
    const float dv = static_cast<float>(v) - centre_v;
    for (int u = 0; u < bgr.cols; ++u) {
      const float du = static_cast<float>(u) - centre_u;
      const float light = 1.0F - vignetting * (du * du + dv * dv) / corner2;
      std::uint64_t bits = rng.NextUint64();
      for (int c = 0; c < 3; ++c, bits >>= 16) {
        const float value = light * static_cast<float>(from[u][c]) + sigma * normal.At(bits);
        to[u][c] = static_cast<unsigned char>(std::clamp(value + 0.5F, 0.0F, 255.0F));
      }
    }
  }
  return noisy;
}

}  // namespace cslam
