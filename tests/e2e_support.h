// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/eval/ate.h"
#include "cslam/pipeline/slam.h"
#include "cslam/sim/test_frames.h"

#include <vector>

namespace cslam::test {

// The default options, with every commit of the map checked and features to suit 320 x 240.
inline SlamOptions CheckedOptions() {
  SlamOptions options;
  options.tracking.orb.num_features = 700;
  options.mapping.check_invariants = true;
  return options;
}

inline RunResult RunSlam(const TestFrames& sequence, Execution execution,
                         const SlamOptions& options = CheckedOptions()) {
  Slam slam(sequence.camera, options, execution);
  for (const auto& frame : sequence.frames)
    slam.Feed(frame);
  return slam.Finish();
}

// RMSE in metres of the final trajectory after SE(3) alignment.
inline double FinalAte(const Trajectory& truth, const RunResult& result) {
  return EvaluateAte(truth, FinalTrajectory(result)).statistics_m.rmse;
}

}  // namespace cslam::test
