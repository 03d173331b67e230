// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/vision/orb_pattern.h"

#include <cmath>
#include <cstring>
#include <numbers>

namespace cslam::orb {
namespace {

constexpr int kRadius = 15;
constexpr std::array<TestPair, 256> kPattern = {{
#include "cslam/vision/orb_pattern.inc"
}};

}  // namespace

std::span<const TestPair, 256> TestPattern() {
  return kPattern;
}

RotatedPattern::RotatedPattern(std::span<const TestPair, 256> pattern) {
  for (int step = 0; step < kSteps; ++step) {
    const double angle = 2.0 * std::numbers::pi * step / kSteps;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const auto offset = [c, s](int x, int y) {
      const long turned_x = std::lround(c * x - s * y);
      const long turned_y = std::lround(s * x + c * y);
      return static_cast<std::uint16_t>((turned_y + kRadius) * kPatchStride + turned_x + kRadius);
    };
    auto& offsets = steps_.emplace_back();
    for (std::size_t i = 0; i < pattern.size(); ++i) {
      const TestPair& test = pattern[i];
      offsets[i] = {offset(test.ax, test.ay), offset(test.bx, test.by)};
    }
  }
}

Descriptor RotatedPattern::Describe(const cv::Mat& blurred, int x, int y, float angle_rad) const {
  constexpr std::size_t kRows = 2 * kRadius + 1;
  std::array<std::uint8_t, kRows * kPatchStride> patch;
  const std::uint8_t* source = blurred.ptr<std::uint8_t>(y - kRadius) + x - kRadius;
  for (std::size_t row = 0; row < kRows; ++row, source += blurred.step[0]) {
    std::memcpy(patch.data() + row * kPatchStride, source, kPatchStride);
  }
  const float turns = angle_rad * static_cast<float>(0.5 / std::numbers::pi);
  const auto step = static_cast<std::size_t>(std::lround(turns * kSteps)) % kSteps;
  const Offsets* tests = steps_[step].data();
  Descriptor descriptor;
  for (std::uint64_t& word : descriptor.words) {
    for (int bit = 0; bit < 64; ++bit, ++tests) {
      const bool is_darker = patch[tests->a] < patch[tests->b];
      word |= static_cast<std::uint64_t>(is_darker) << bit;
    }
  }
  return descriptor;
}

}  // namespace cslam::orb
