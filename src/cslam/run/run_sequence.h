// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/dataset.h"
#include "cslam/pipeline/slam.h"
#include "cslam/run/run_log.h"
#include "cslam/run/sequence_player.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace cslam {

struct RunSettings {
  Execution execution = Execution::kThreaded;
  PlayRate rate = PlayRate::kMax;
};

// What a run took, from its first frame read to its last one processed.
struct RunCost {
  double wall_s = 0.0;
  double cpu_s = 0.0;  // all threads, reading of images included
  std::size_t peak_memory_bytes = 0;
};

// Everything known when the last frame has been processed.
struct RunOutcome {
  RunResult result;
  RunLog log;
  PlayReport play;
  RunCost cost;
};

// Runs SLAM on a data set. Inline execution uses one thread for everything, reading included.
// is_interrupted is asked before every frame; true ends the run with what there is. Throws Error
// for options or frames that cannot be used. detector: null for none.
RunOutcome RunSequence(const DatasetReader& dataset, const SlamOptions& options,
                       const RunSettings& settings, std::unique_ptr<Detector> detector,
                       std::vector<std::shared_ptr<OutputSink>> listeners,
                       const std::function<bool()>& is_interrupted);

}  // namespace cslam
