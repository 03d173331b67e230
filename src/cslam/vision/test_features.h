// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/util/random.h"
#include "cslam/vision/frame_features.h"

#include <utility>
#include <vector>

namespace cslam::test {

// A descriptor whose first num_bits bits are set: num_bits away from the empty one.
inline Descriptor FirstBits(int num_bits) {
  Descriptor descriptor = {};
  for (int bit = 0; bit < num_bits; ++bit)
    descriptor.words[static_cast<std::size_t>(bit / 64)] |= std::uint64_t{1} << (bit % 64);
  return descriptor;
}

// Two of these differ in about 128 bits.
inline Descriptor RandomDescriptor(Rng& rng) {
  Descriptor descriptor = {};
  for (std::uint64_t& word : descriptor.words)
    word = rng.NextUint64();
  return descriptor;
}

struct Feature {
  float u = 0.0F, v = 0.0F;  // px
  Descriptor descriptor = {};
  int octave = 0;
  float angle_rad = 0.0F;
  float disparity_px = -1.0F;
  float depth_m = 0.0F;
};

// Features of a 640 x 480 image without distortion.
inline FrameFeatures MakeFeatures(const std::vector<Feature>& list) {
  FrameFeatures features;
  for (const Feature& f : list) {
    Keypoint keypoint;
    keypoint.uv_px = keypoint.raw_px = {f.u, f.v};
    keypoint.octave = f.octave;
    keypoint.angle_rad = f.angle_rad;
    keypoint.disparity_px = f.disparity_px;
    keypoint.depth_m = f.depth_m;
    features.keypoints.push_back(keypoint);
    features.descriptors.push_back(f.descriptor);
  }
  features.semantics.resize(list.size());
  features.grid = KeypointGrid({0.0, 640.0, 0.0, 480.0}, features.keypoints);
  return features;
}

}  // namespace cslam::test
