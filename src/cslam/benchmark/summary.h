// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/benchmark/plan.h"
#include "cslam/benchmark/run_figures.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cslam {

// Of several runs. Runs without the figure do not count.
struct Spread {
  int count = 0;
  double median = 0.0;
  double min = 0.0;
  double max = 0.0;
};
std::optional<Spread> SpreadOf(std::span<const std::optional<double>> values);

// One run with its figures; none: it failed.
struct FinishedRun {
  PlannedRun run;
  std::optional<RunFigures> figures;
  std::string problem;  // why there are none
};

// A trajectory of another system.
struct OtherTrajectory {
  std::string label;
  std::string sequence;
  std::uint64_t seed = 1;
  std::optional<double> ate_m;
  std::string problem;  // why there is no error
};

struct PooledScores {
  DetectionScore objects;
  DetectionScore changes;
};

struct BenchmarkResult {
  BenchmarkRequest request;
  BenchmarkPlan plan;
  std::vector<FinishedRun> runs;
  std::vector<OtherTrajectory> others;
  std::vector<std::pair<std::string, std::string>> facts;  // program, host, detector, ...

  // Over seeds and repeats of a sequence.
  std::optional<Spread> Of(const std::string& sequence, ObjectLayer layer,
                           const FigureInfo& figure) const;
  std::optional<Spread> OfOther(const std::string& sequence, const std::string& label) const;
  // What all runs of a sequence got right and wrong together; of all sequences for an empty name.
  PooledScores Pooled(const std::string& sequence, ObjectLayer layer) const;
  // Median with the layer on over median with it off.
  std::optional<double> Ratio(const std::string& sequence, const FigureInfo& figure) const;
  // The mean of the sequences' medians; nothing if one has none.
  std::optional<double> MeanOfMedians(ObjectLayer layer, const FigureInfo& figure) const;
  std::vector<std::string> Labels() const;  // of the others, each once
  int num_failed() const;

  // The run whose error is nearest to the median one, or the first where none has an error: to be
  // drawn. Null: no run has figures.
  const FinishedRun* Typical(const std::string& sequence, ObjectLayer layer) const;
};

}  // namespace cslam
