// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/run/run_log.h"
#include "cslam/util/stopwatch.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace cslam {

// The value below which the given share of sorted lies, interpolated as NumPy does; share: 0 to 1.
// 0 without values.
double Quantile(std::span<const double> sorted, double share);

struct TimeSummary {
  double median_ms = 0.0;
  double p95_ms = 0.0;
  double p99_ms = 0.0;
  double max_ms = 0.0;
  double total_ms = 0.0;
};
TimeSummary SummariseTimes(std::vector<double> times_ms);

// Times of one step over a whole run.
struct StageSummary {
  std::string name;       // "tracking.extract"; "tracking" is the sum of its steps in one frame
  std::size_t count = 0;  // how often it ran
  TimeSummary wall;
  TimeSummary cpu;  // of the thread that ran it
};

StageSummary SummariseStage(std::string name, std::span<const LapTime> laps);

// "load" if anything was loaded, tracking and its steps (per frame), mapping and its steps (per
// keyframe).
std::vector<StageSummary> SummariseStages(const RunLog& log, std::span<const LapTime> loads);

// The sum of all steps.
LapTime TotalOf(const std::vector<StageTime>& times);

}  // namespace cslam
