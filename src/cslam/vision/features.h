// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/util/id.h"

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace cslam {

// A 256-bit binary descriptor.
struct Descriptor {
  std::array<std::uint64_t, 4> words{};
  bool operator==(const Descriptor&) const = default;
};

// Number of differing bits, 0 to 256.
inline int HammingDistance(const Descriptor& a, const Descriptor& b) {
  return std::popcount(a.words[0] ^ b.words[0]) + std::popcount(a.words[1] ^ b.words[1]) +
         std::popcount(a.words[2] ^ b.words[2]) + std::popcount(a.words[3] ^ b.words[3]);
}

// A corner as the extractor finds it, in raw (distorted) full-resolution pixels.
struct Corner {
  float u = 0.0F, v = 0.0F;  // px
  float angle_rad = 0.0F;    // intensity-centroid orientation, [0, 2 pi)
  float response = 0.0F;     // FAST score
  int octave = 0;            // pyramid level, 0 = full resolution
};

// What an extractor returns: two arrays of equal length, ordered by (octave, v, u).
struct OrbFeatures {
  std::vector<Corner> corners;
  std::vector<Descriptor> descriptors;
};

}  // namespace cslam
