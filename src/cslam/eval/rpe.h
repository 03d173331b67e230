// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/eval/pose_association.h"
#include "cslam/eval/statistics.h"

#include <cstddef>
#include <string>
#include <vector>

namespace cslam {

enum class DeltaUnit { kFrames, kSeconds, kMetres };

enum class RpePairs {
  kConsecutive,  // each pair begins where the last one ends
  kAll,          // a pair begins at every pose
};

struct RpeOptions {
  PoseAssociationOptions association;
  // Frames are matched poses; metres are measured along the path of the reference.
  double delta = 1.0;
  DeltaUnit unit = DeltaUnit::kFrames;
  RpePairs pairs = RpePairs::kConsecutive;
  double tolerance = 0.1;  // share of delta by which seconds and metres may miss it
};

// One relative motion, between matched poses first and last.
struct RelativeError {
  std::size_t first = 0;  // indices into PoseAssociation::pairs
  std::size_t last = 0;
  double translation_m = 0.0;
  double rotation_rad = 0.0;
};

// Relative pose error: how far the motion between two poses differs from the true motion. No
// alignment is needed, but both trajectories must follow the same body: the camera, not markers
// mounted beside it.
struct RpeResult {
  RpeOptions options;
  PoseAssociation association;
  std::vector<RelativeError> errors;
  ErrorStatistics translation_m;  // max_index is into errors
  ErrorStatistics rotation_rad;
};

// Throws Error if no poses can be paired, or none of the pairs is delta apart, and for a delta
// that is not positive (frames: not a whole number).
RpeResult EvaluateRpe(const Trajectory& reference, const Trajectory& estimate,
                      const RpeOptions& options = {});

// "delta 1 frame, consecutive pairs".
std::string DescribeDelta(const RpeOptions& options);

}  // namespace cslam
