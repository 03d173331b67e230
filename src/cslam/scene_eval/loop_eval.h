// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/trajectory.h"
#include "cslam/scene_eval/scene_run.h"

#include <optional>
#include <vector>

namespace cslam {

struct LoopEvalOptions {
  double max_error_m = 0.2;  // of the relative pose of the two frames: more is false
  double max_error_deg = 10.0;
  double max_stamp_gap_s = 0.02;  // to the true pose
};

struct JudgedLoop {
  AcceptedLoop loop;
  double error_m = 0.0;
  double error_deg = 0.0;
  bool is_false = false;
};

struct LoopEvaluation {
  std::vector<JudgedLoop> loops;  // that have true poses at both ends
  int num_false = 0;
  int num_without_truth = 0;
};

// Holds loops and merges that a run accepted against the true poses of their frames.
LoopEvaluation EvaluateLoops(const Trajectory& truth, const std::vector<AcceptedLoop>& loops,
                             const LoopEvalOptions& options = {});

}  // namespace cslam
