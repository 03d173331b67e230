// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/color_noise.h"

#include "cslam/sim/noise_fields.h"
#include "cslam/util/check.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace cslam {
namespace {

constexpr double kGamma = 2.2;  // display value = light to the power of 1 / kGamma

float DisplayGain(double exposure) {
  return static_cast<float>(std::pow(exposure, 1.0 / kGamma));
}

cv::Mat Soften(const cv::Mat& bgr, double sigma_px) {
  constexpr double kMinSigmaPx = 0.15;  // less has no effect
  if (sigma_px < kMinSigmaPx) return bgr;
  const int radius = std::max(1, static_cast<int>(std::ceil(2.5 * sigma_px)));
  cv::Mat soft;
  cv::GaussianBlur(bgr, soft, {2 * radius + 1, 2 * radius + 1}, sigma_px, sigma_px);
  return soft;
}

// A field of patches per channel; empty if there are none.
std::array<cv::Mat, 3> Patches(cv::Size size, const ColorNoiseOptions& options, std::uint64_t seed,
                               std::uint64_t frame) {
  std::array<cv::Mat, 3> patches;
  if (options.patch_sigma <= 0.0) return patches;
  const double spacing_px = std::max(1.0, options.patch_size_px * size.width / 640.0);
  Rng rng = MakeNoiseRng(seed, frame, NoisePurpose::kColorPatches);
  for (cv::Mat& field : patches)
    field = options.patch_sigma * SmoothNormal(size, spacing_px, Rng(rng.NextUint64()));
  return patches;
}

}  // namespace

ColorNoiseOptions D435iColorNoise() {
  return {.sigma = 0.1,
          .patch_sigma = 0.8,
          .patch_size_px = 6.0,
          .softness_px = 0.85,
          .vignetting = 0.15,
          .exposure = 1.0};
}

cv::Mat Expose(const cv::Mat& bgr, double exposure) {
  if (exposure == 1.0) return bgr;
  cv::Mat result;
  bgr.convertTo(result, CV_8U, static_cast<double>(DisplayGain(exposure)));
  return result;
}

cv::Mat AddColorNoise(const cv::Mat& bgr, const ColorNoiseOptions& options, std::uint64_t seed,
                      std::uint64_t frame) {
  CSLAM_CHECK(bgr.type() == CV_8UC3);
  const NormalTable normal(MakeNoiseRng(seed, frame, NoisePurpose::kTable));
  Rng rng = MakeNoiseRng(seed, frame, NoisePurpose::kColor);
  const cv::Mat soft = Soften(bgr, options.softness_px * bgr.cols / 640.0);
  const std::array<cv::Mat, 3> patches = Patches(bgr.size(), options, seed, frame);
  const auto sigma = static_cast<float>(options.sigma);
  const auto vignetting = static_cast<float>(options.vignetting);
  const float gain = DisplayGain(options.exposure);
  const float centre_u = 0.5F * static_cast<float>(bgr.cols);
  const float centre_v = 0.5F * static_cast<float>(bgr.rows);
  const float corner2 = centre_u * centre_u + centre_v * centre_v;
  cv::Mat noisy(bgr.size(), CV_8UC3);
  for (int v = 0; v < bgr.rows; ++v) {
    const auto* from = soft.ptr<cv::Vec3b>(v);
    auto* to = noisy.ptr<cv::Vec3b>(v);
    std::array<const float*, 3> patch_rows{};
    for (std::size_t c = 0; c < 3 && !patches[c].empty(); ++c)
      patch_rows[c] = patches[c].ptr<float>(v);
    const float dv = static_cast<float>(v) - centre_v;
    for (int u = 0; u < bgr.cols; ++u) {
      const float du = static_cast<float>(u) - centre_u;
      const float light = gain * (1.0F - vignetting * (du * du + dv * dv) / corner2);
      std::uint64_t bits = rng.NextUint64();
      for (int c = 0; c < 3; ++c, bits >>= 16) {
        const float* const patch = patch_rows[static_cast<std::size_t>(c)];
        const float value = light * static_cast<float>(from[u][c]) + sigma * normal.At(bits) +
                            (patch != nullptr ? patch[u] : 0.0F);
        to[u][c] = static_cast<unsigned char>(std::clamp(value + 0.5F, 0.0F, 255.0F));
      }
    }
  }
  return noisy;
}

}  // namespace cslam
