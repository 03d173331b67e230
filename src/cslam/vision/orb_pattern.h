// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/vision/features.h"

#include <opencv2/core/mat.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cslam::orb {

// One binary test: is the smoothed image darker at a than at b? Offsets from the corner in px.
struct TestPair {
  std::int8_t ax = 0, ay = 0, bx = 0, by = 0;
};

// The 256 tests of a descriptor, inside a disc of 15 px. Made by bench/learn_orb_pattern.cpp.
std::span<const TestPair, 256> TestPattern();

// A pattern turned to each of kSteps directions.
class RotatedPattern {
 public:
  static constexpr int kSteps = 64;

  explicit RotatedPattern(std::span<const TestPair, 256> pattern);

  // blurred: CV_8UC1; (x, y) at least 15 px, to the right 16 px, from its edges.
  Descriptor Describe(const cv::Mat& blurred, int x, int y, float angle_rad) const;

 private:
  static constexpr int kPatchStride = 32;
  struct Offsets {
    std::uint16_t a = 0, b = 0;  // into a patch of 31 rows of kPatchStride
  };
  std::vector<std::array<Offsets, 256>> steps_;
};

}  // namespace cslam::orb
