// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/stage_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>
#include <utility>

namespace cslam {
namespace {

// Times by step, in the order in which steps first ran.
class StepTimes {
 public:
  void Add(const std::vector<StageTime>& times) {
    totals_.push_back(TotalOf(times));
    for (const StageTime& time : times)
      LapsOf(time.stage).push_back({.wall_ms = time.ms, .cpu_ms = time.cpu_ms});
  }

  // The sum of the steps first, under the name of the group.
  void AppendSummaries(const std::string& group, std::vector<StageSummary>& summaries) const {
    if (totals_.empty()) return;
    summaries.push_back(SummariseStage(group, totals_));
    for (const auto& [step, laps] : steps_)
      summaries.push_back(SummariseStage(fmt::format("{}.{}", group, step), laps));
  }

 private:
  std::vector<LapTime>& LapsOf(std::string_view step) {
    const auto found = std::find_if(steps_.begin(), steps_.end(),
                                    [&](const auto& entry) { return entry.first == step; });
    if (found != steps_.end()) return found->second;
    return steps_.emplace_back(std::string(step), std::vector<LapTime>()).second;
  }

  std::vector<LapTime> totals_;
  std::vector<std::pair<std::string, std::vector<LapTime>>> steps_;
};

}  // namespace

double Quantile(std::span<const double> sorted, double share) {
  if (sorted.empty()) return 0.0;
  const double position = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(std::floor(position));
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double weight = position - static_cast<double>(below);
  return (1.0 - weight) * sorted[below] + weight * sorted[above];
}

TimeSummary SummariseTimes(std::vector<double> times_ms) {
  std::sort(times_ms.begin(), times_ms.end());
  return {.median_ms = Quantile(times_ms, 0.5),
          .p95_ms = Quantile(times_ms, 0.95),
          .p99_ms = Quantile(times_ms, 0.99),
          .max_ms = times_ms.empty() ? 0.0 : times_ms.back(),
          .total_ms = std::accumulate(times_ms.begin(), times_ms.end(), 0.0)};
}

StageSummary SummariseStage(std::string name, std::span<const LapTime> laps) {
  std::vector<double> wall_ms;
  std::vector<double> cpu_ms;
  for (const LapTime& lap : laps) {
    wall_ms.push_back(lap.wall_ms);
    cpu_ms.push_back(lap.cpu_ms);
  }
  return {.name = std::move(name),
          .count = laps.size(),
          .wall = SummariseTimes(std::move(wall_ms)),
          .cpu = SummariseTimes(std::move(cpu_ms))};
}

std::vector<StageSummary> SummariseStages(const RunLog& log, std::span<const LapTime> loads) {
  std::vector<StageSummary> summaries;
  if (!loads.empty()) summaries.push_back(SummariseStage("load", loads));
  StepTimes tracking;
  for (const TrackingResult& frame : log.frames)
    tracking.Add(frame.times);
  tracking.AppendSummaries("tracking", summaries);
  StepTimes mapping;
  for (const auto& times : log.mapper_steps)
    mapping.Add(times);
  mapping.AppendSummaries("mapping", summaries);
  return summaries;
}

LapTime TotalOf(const std::vector<StageTime>& times) {
  LapTime total;
  for (const StageTime& time : times) {
    total.wall_ms += time.ms;
    total.cpu_ms += time.cpu_ms;
  }
  return total;
}

}  // namespace cslam
