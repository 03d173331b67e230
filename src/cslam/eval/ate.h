// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/eval/pose_association.h"
#include "cslam/eval/statistics.h"
#include "cslam/geometry/alignment.h"

#include <string>
#include <vector>

namespace cslam {

// How the estimate is brought into the frame of the reference before they are compared.
enum class TrajectoryAlignment {
  kNone,    // both are in the same frame already
  kOrigin,  // the first pair of poses coincides
  kSe3,     // rigid least squares over all camera centres (Umeyama), scale 1
  kSim3,    // the same with scale
};

struct AteOptions {
  PoseAssociationOptions association;
  TrajectoryAlignment alignment = TrajectoryAlignment::kSe3;
};

// Absolute trajectory error: distances between camera centres that belong together.
struct AteResult {
  AteOptions options;
  PoseAssociation association;   // as given, not aligned
  Alignment alignment;           // maps the estimate's world (b) onto the reference's (a)
  std::vector<double> errors_m;  // one for each pair
  ErrorStatistics statistics_m;
};

// Throws Error if no poses can be paired, or if the pairs leave the alignment open: fewer than
// three, or camera centres on one line.
AteResult EvaluateAte(const Trajectory& reference, const Trajectory& estimate,
                      const AteOptions& options = {});

// The pose brought into the frame of the reference: centre mapped, camera turned along.
Se3 Align(const Alignment& alignment, const Se3& T_world_camera);
Trajectory Align(const Alignment& alignment, const Trajectory& estimate);

// "SE(3) Umeyama alignment without scale".
std::string Describe(TrajectoryAlignment alignment);

}  // namespace cslam
