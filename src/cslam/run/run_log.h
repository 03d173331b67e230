// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/pipeline/sink.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace cslam {

// What the mapper did during a run, added up.
struct MappingCounts {
  std::size_t keyframes_inserted = 0;
  std::size_t keyframes_refused = 0;
  std::size_t keyframes_culled = 0;
  std::size_t points_created = 0;
  std::size_t points_fused = 0;
  std::size_t points_culled = 0;
  std::size_t ba_runs = 0;
  std::size_t ba_iterations = 0;
  std::size_t ba_stopped = 0;  // ended early because the next proposal waited
};

// All that was published during a run.
struct RunLog {
  std::vector<TrackingResult> frames;                // one per frame processed, in order
  std::vector<std::vector<StageTime>> mapper_steps;  // one per keyframe: insertion and refinement
  std::vector<LoopRecord> loops;                     // candidates, in order
  MappingCounts mapping;
  std::optional<double> first_pose_ms;  // from the start of the process to the first pose
};

// Listens to a run and keeps its log.
class RunRecorder : public OutputSink {
 public:
  void OnFrame(const TrackingResult& result) override;
  void OnLoop(const LoopRecord& record) override { log_.loops.push_back(record); }
  void OnMap(const MapUpdate& update) override;

  // After Slam::Finish().
  const RunLog& log() const { return log_; }

 private:
  RunLog log_;
};

}  // namespace cslam
