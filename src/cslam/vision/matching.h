// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/vision/frame_features.h"

#include <limits>
#include <span>
#include <vector>

namespace cslam {

class OptionList;

// A point expected in a frame: where, how large, and what it looks like.
struct ProjectionQuery {
  Eigen::Vector2f uv_px;       // predicted, undistorted
  float disparity_px = -1.0F;  // predicted; negative: do not compare
  float radius_px = 0.0F;      // search radius, at full resolution
  int min_octave = 0;
  int max_octave = std::numeric_limits<int>::max();
  Descriptor descriptor;
  float angle_rad = -1.0F;  // of the keypoint it was seen as last; negative: unknown
};

struct Match {
  int query = 0;     // index of the query
  int keypoint = 0;  // index of the keypoint it was found as
  int distance = 0;  // Hamming
};

struct MatchOptions {
  int max_distance = 100;       // bits of 256 that may differ
  double max_ratio = 1.0;       // best / second best of the same octave; 1 switches the test off
  bool check_rotation = false;  // drop matches whose rotation disagrees with the majority
};

// Finds each query among the keypoints near its prediction. keypoint_is_taken (empty or one per
// keypoint) excludes keypoints. Every keypoint is given to at most one query: the nearest in
// descriptor, the first of equals. Sorted by query.
std::vector<Match> MatchByProjection(const FrameFeatures& features,
                                     std::span<const ProjectionQuery> queries,
                                     const MatchOptions& options,
                                     std::span<const std::uint8_t> keypoint_is_taken = {});

// Mutual best matches between the listed descriptors of two frames; Match::query indexes a's
// features and Match::keypoint b's.
std::vector<Match> MatchByDescriptor(const FrameFeatures& a, std::span<const int> indices_a,
                                     const FrameFeatures& b, std::span<const int> indices_b,
                                     const MatchOptions& options);

// The descriptor with the smallest median distance to the others. descriptors must not be empty.
std::size_t MedoidIndex(std::span<const Descriptor> descriptors);

}  // namespace cslam
