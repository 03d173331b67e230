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
  TrackingMode mode = TrackingMode::kMapping;
};

// What a run is given besides frames.
struct RunParts {
  std::unique_ptr<Detector> detector = {};                  // null: none
  std::optional<Map> map = {};                              // of an earlier run, to go on in
  std::vector<std::shared_ptr<OutputSink>> listeners = {};  // told what happens
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
// for options, frames or a map that cannot be used.
RunOutcome RunSequence(const DatasetReader& dataset, const SlamOptions& options,
                       const RunSettings& settings, RunParts parts,
                       const std::function<bool()>& is_interrupted);

}  // namespace cslam
