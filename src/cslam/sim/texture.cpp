// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/texture.h"

#include "cslam/util/check.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace cslam {
namespace {

constexpr int kMaxTaps = 4;
// A real lens and sensor blur a little; this also keeps corners stable between frames.
constexpr float kLevelBias = 0.15F;

using Bgra = std::array<unsigned char, 4>;

// Four channels, though the last means nothing: they fit one vector register.
Eigen::Array4f ToFloat(const Bgra& texel) {
#if defined(__SSE2__)
  int bytes = 0;
  std::memcpy(&bytes, texel.data(), sizeof(bytes));
  const __m128i zero = _mm_setzero_si128();
  const __m128i words = _mm_unpacklo_epi8(_mm_cvtsi32_si128(bytes), zero);
  Eigen::Array4f values;
  _mm_store_ps(values.data(), _mm_cvtepi32_ps(_mm_unpacklo_epi16(words, zero)));
  return values;
#else
  return {static_cast<float>(texel[0]), static_cast<float>(texel[1]), static_cast<float>(texel[2]),
          0.0F};
#endif
}

int FloorToInt(float x) {
  const int truncated = static_cast<int>(x);
  return static_cast<float>(truncated) > x ? truncated - 1 : truncated;
}

// A coordinate in periods to the texel left of it, in [0, size), and the share of the next one.
struct TexelIndex {
  int first;
  int second;
  float share;
};

TexelIndex Locate(float periods, int size) {
  const float wrapped = periods - static_cast<float>(FloorToInt(periods));
  const float x = wrapped * static_cast<float>(size) - 0.5F;
  const int left = FloorToInt(x);
  const float share = x - static_cast<float>(left);
  const int first = left < 0 ? size - 1 : std::min(left, size - 1);
  return {first, first + 1 == size ? 0 : first + 1, share};
}

}  // namespace

Texture::Texture(const cv::Mat& bgr) {
  CSLAM_CHECK(bgr.type() == CV_8UC3 && !bgr.empty(), "a texture needs an 8-bit colour image");
  cv::Mat bgra;
  cv::cvtColor(bgr, bgra, cv::COLOR_BGR2BGRA);
  levels_.push_back(bgra);
  while (levels_.back().cols > 1 || levels_.back().rows > 1) {
    const cv::Size size(std::max(1, levels_.back().cols / 2), std::max(1, levels_.back().rows / 2));
    cv::Mat half;
    cv::resize(levels_.back(), half, size, 0.0, 0.0, cv::INTER_AREA);
    levels_.push_back(half);
  }
}

Eigen::Array4f Texture::Bilinear(int level, const Eigen::Vector2f& uv) const {
  const cv::Mat& image = levels_[static_cast<std::size_t>(level)];
  const TexelIndex x = Locate(uv.x(), image.cols);
  const TexelIndex y = Locate(uv.y(), image.rows);
  const auto* top = image.ptr<Bgra>(y.first);
  const auto* bottom = image.ptr<Bgra>(y.second);
  const float lower = y.share;
  const float upper = 1.0F - y.share;
  return upper * (1.0F - x.share) * ToFloat(top[x.first]) +
         upper * x.share * ToFloat(top[x.second]) +
         lower * (1.0F - x.share) * ToFloat(bottom[x.first]) +
         lower * x.share * ToFloat(bottom[x.second]);
}

Eigen::Array4f Texture::Trilinear(float level, const Eigen::Vector2f& uv) const {
  const int fine = static_cast<int>(level);
  const float share = level - static_cast<float>(fine);
  if (fine + 1 >= num_levels()) return Bilinear(num_levels() - 1, uv);
  if (share == 0.0F) return Bilinear(fine, uv);
  return (1.0F - share) * Bilinear(fine, uv) + share * Bilinear(fine + 1, uv);
}

Eigen::Array3f Texture::Sample(const Eigen::Vector2f& uv, const Eigen::Vector2f& footprint_x,
                               const Eigen::Vector2f& footprint_y) const {
  const Eigen::Array2f size(static_cast<float>(width()), static_cast<float>(height()));
  const float length_x = (footprint_x.array() * size).matrix().norm();
  const float length_y = (footprint_y.array() * size).matrix().norm();
  const bool x_is_longer = length_x > length_y;
  const float longer = std::max(length_x, length_y);
  const float shorter = std::max(std::min(length_x, length_y), 1e-6F);
  const int taps = std::clamp(static_cast<int>(std::ceil(longer / shorter - 0.3F)), 1, kMaxTaps);
  const float texels = std::max(longer / static_cast<float>(taps), shorter);
  const float level = std::max(0.0F, std::log2(texels) + kLevelBias);
  if (taps == 1) return Trilinear(level, uv).head<3>();

  const Eigen::Vector2f step = (x_is_longer ? footprint_x : footprint_y) / static_cast<float>(taps);
  Eigen::Vector2f tap = uv - 0.5F * static_cast<float>(taps - 1) * step;
  Eigen::Array4f sum = Eigen::Array4f::Zero();
  for (int i = 0; i < taps; ++i, tap += step)
    sum += Trilinear(level, tap);
  return sum.head<3>() / static_cast<float>(taps);
}

}  // namespace cslam
