// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/run_sequence.h"

#include "cslam/run/process_info.h"
#include "cslam/util/check.h"
#include "cslam/util/stopwatch.h"

#include <utility>

namespace cslam {

RunOutcome RunSequence(const DatasetReader& dataset, const SlamOptions& options,
                       const RunSettings& settings, RunParts parts,
                       const std::function<bool()>& is_interrupted) {
  const bool is_inline = settings.execution == Execution::kInline;
  const bool is_sensor_rate = settings.rate == PlayRate::kSensor;
  CSLAM_CHECK(!(is_inline && is_sensor_rate), "inline execution cannot drop frames");
  const auto recorder = std::make_shared<RunRecorder>();
  parts.listeners.push_back(recorder);
  RunOutcome outcome;
  const Stopwatch watch;
  const double cpu_before_s = ProcessCpuSeconds();
  {
    Slam slam(dataset.camera().camera, options, settings.execution, std::move(parts.listeners),
              is_sensor_rate ? FeedPolicy::kDropOldest : FeedPolicy::kWait,
              std::move(parts.detector));
    if (parts.map) slam.Continue(*std::move(parts.map));
    slam.SetMode(settings.mode);
    outcome.play =
        Play(dataset, slam, {.rate = settings.rate, .read_ahead = !is_inline}, is_interrupted);
    outcome.result = slam.Finish();
  }
  outcome.cost.wall_s = 1e-3 * watch.ElapsedMs();
  outcome.cost.cpu_s = ProcessCpuSeconds() - cpu_before_s;
  outcome.cost.peak_memory_bytes = PeakMemoryBytes();
  outcome.log = recorder->log();
  return outcome;
}

}  // namespace cslam
