// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/util/random.h"

#include <opencv2/core/mat.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace cslam {

// What a generator of sensor noise is for: one stream of random numbers each.
enum class NoisePurpose : std::uint64_t {
  kTable = 11,
  kPixels = 12,
  kPatches = 13,
  kDropout = 14,
  kColor = 15,
  kColorPatches = 16
};

inline Rng MakeNoiseRng(std::uint64_t seed, std::uint64_t frame, NoisePurpose purpose) {
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

// H x W, CV_32FC1: standard normal on a grid of the given spacing (px), smooth in between.
cv::Mat SmoothNormal(cv::Size size, double spacing_px, Rng rng);

}  // namespace cslam
