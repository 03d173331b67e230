// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/benchmark/summary.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cslam {

std::optional<Spread> SpreadOf(std::span<const std::optional<double>> values) {
  std::vector<double> sorted;
  for (const std::optional<double>& value : values) {
    if (value) sorted.push_back(*value);
  }
  if (sorted.empty()) return std::nullopt;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t n = sorted.size();
  return Spread{.count = static_cast<int>(n),
                .median = 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]),
                .min = sorted.front(),
                .max = sorted.back()};
}

std::optional<Spread> BenchmarkResult::Of(const std::string& sequence, ObjectLayer layer,
                                          const FigureInfo& figure) const {
  std::vector<std::optional<double>> values;
  for (const FinishedRun& run : runs) {
    const bool is_meant =
        run.run.layer == layer && plan.data[run.run.data].sequence == sequence && run.figures;
    if (is_meant) values.push_back((*run.figures).*figure.value);
  }
  return SpreadOf(values);
}

PooledScores BenchmarkResult::Pooled(const std::string& sequence, ObjectLayer layer) const {
  const auto count = [](const std::optional<double>& value) {
    return static_cast<int>(std::lround(value.value_or(0.0)));
  };
  PooledScores pooled;
  for (const FinishedRun& run : runs) {
    const bool is_meant = sequence.empty() || plan.data[run.run.data].sequence == sequence;
    if (run.run.layer != layer || !is_meant || !run.figures) continue;
    const RunFigures& f = *run.figures;
    pooled.objects += {count(f.objects_true), count(f.objects_reported), count(f.objects_matched)};
    pooled.changes += {count(f.changes_true), count(f.changes_reported), count(f.changes_matched)};
  }
  return pooled;
}

std::optional<Spread> BenchmarkResult::OfOther(const std::string& sequence,
                                               const std::string& label) const {
  std::vector<std::optional<double>> values;
  for (const OtherTrajectory& other : others) {
    if (other.sequence == sequence && other.label == label) values.push_back(other.ate_m);
  }
  return SpreadOf(values);
}

std::optional<double> BenchmarkResult::Ratio(const std::string& sequence,
                                             const FigureInfo& figure) const {
  const auto on = Of(sequence, ObjectLayer::kOn, figure);
  const auto off = Of(sequence, ObjectLayer::kOff, figure);
  if (!on || !off || off->median <= 0.0) return std::nullopt;
  return on->median / off->median;
}

std::optional<double> BenchmarkResult::MeanOfMedians(ObjectLayer layer,
                                                     const FigureInfo& figure) const {
  const std::vector<std::string> sequences = plan.Sequences();
  double sum = 0.0;
  for (const std::string& sequence : sequences) {
    const auto spread = Of(sequence, layer, figure);
    if (!spread) return std::nullopt;
    sum += spread->median;
  }
  if (sequences.empty()) return std::nullopt;
  return sum / static_cast<double>(sequences.size());
}

std::vector<std::string> BenchmarkResult::Labels() const {
  std::vector<std::string> labels;
  for (const OtherTrajectory& other : others) {
    if (std::find(labels.begin(), labels.end(), other.label) == labels.end()) {
      labels.push_back(other.label);
    }
  }
  return labels;
}

int BenchmarkResult::num_failed() const {
  return static_cast<int>(
      std::count_if(runs.begin(), runs.end(), [](const FinishedRun& run) { return !run.figures; }));
}

const FinishedRun* BenchmarkResult::Typical(const std::string& sequence, ObjectLayer layer) const {
  const auto median = Of(sequence, layer, FigureOf("ate_m"));
  const FinishedRun* best = nullptr;
  double best_distance = std::numeric_limits<double>::infinity();
  for (const FinishedRun& run : runs) {
    if (run.run.layer != layer || plan.data[run.run.data].sequence != sequence) continue;
    if (!run.figures || (median && !run.figures->ate_m)) continue;
    const double distance = median ? std::abs(*run.figures->ate_m - median->median) : 0.0;
    if (distance >= best_distance) continue;
    best_distance = distance;
    best = &run;
  }
  return best;
}

}  // namespace cslam
