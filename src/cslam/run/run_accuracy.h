// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/eval/ate.h"
#include "cslam/eval/rpe.h"
#include "cslam/geometry/trajectory.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cslam {

// Errors of one trajectory; absent where they cannot be measured.
struct TrajectoryAccuracy {
  std::optional<AteResult> ate;
  std::optional<RpeResult> rpe;  // of one frame's motion
};

struct RunAccuracy {
  std::string ate_reference;  // paths; empty without ground truth
  std::string rpe_reference;
  Trajectory reference;               // that of ATE
  TrajectoryAccuracy final_poses;     // trajectory.txt
  TrajectoryAccuracy live_poses;      // trajectory_live.txt
  std::vector<std::string> problems;  // why something could not be measured, one line each
};

// Compares both trajectories with ground_truth. RPE takes groundtruth_camera.txt beside it instead
// if there is one: relative motion must be that of the camera, not of markers beside it. Broken or
// degenerate ground truth never throws; it is told in problems.
RunAccuracy MeasureAccuracy(const std::filesystem::path& ground_truth,
                            const Trajectory& final_poses, const Trajectory& live_poses);

}  // namespace cslam
