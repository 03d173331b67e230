// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/trajectory.h"

#include <cstddef>
#include <string>
#include <vector>

namespace cslam {

enum class PoseAssociationMode {
  kNearest,      // the pose with the nearest stamp
  kInterpolate,  // the reference, interpolated at the stamps of the estimate
};

struct PoseAssociationOptions {
  PoseAssociationMode mode = PoseAssociationMode::kNearest;
  double window_s = 0.02;               // kNearest: largest difference of stamps
  double max_interpolated_gap_s = 0.1;  // kInterpolate: longest gap of the reference to bridge
};

// A pose of the estimate and that of the reference at the same time.
struct PosePair {
  Stamp stamp;  // of the estimate
  Se3 reference;
  Se3 estimate;
};

struct PoseAssociation {
  std::vector<PosePair> pairs;    // in order of time
  std::size_t num_reference = 0;  // poses given
  std::size_t num_estimate = 0;
  double max_difference_s = 0.0;  // largest difference of stamps in a pair; 0 if interpolated

  // Shares of the given poses that have a partner, 0 to 1.
  double EstimateShare() const;
  double ReferenceShare() const;
};

// Pairs the poses of two trajectories by time. Nearest: each pose of the shorter trajectory takes
// the nearest of the longer one within the window (the earlier of two equally near); where two
// want the same, the nearer gets it, so every pose is used at most once. Nothing to pair gives no
// pairs. Throws Error for a window or gap that is negative or not finite.
PoseAssociation AssociatePoses(const Trajectory& reference, const Trajectory& estimate,
                               const PoseAssociationOptions& options = {});

// The same, but throws Error that says why when there is nothing to compare: a trajectory without
// poses, no overlap in time, or stamps further apart than the window.
PoseAssociation AssociatePosesOrThrow(const Trajectory& reference, const Trajectory& estimate,
                                      const PoseAssociationOptions& options = {});

// "nearest stamp within 0.02 s".
std::string Describe(const PoseAssociationOptions& options);

}  // namespace cslam
