// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/benchmark/summary.h"

namespace cslam::test {

// Two seeds of one sequence, one run each with the layer on and off.
inline BenchmarkResult TwoSeeds() {
  BenchmarkResult result;
  result.request = {.folder = "bench", .sequences = {"onechair"}, .is_short = true, .num_seeds = 2};
  result.plan = MakePlan(result.request);
  const double ate_m[] = {0.010, 0.050, 0.014, 0.070};  // on, off, on, off
  for (std::size_t i = 0; i < result.plan.runs.size(); ++i) {
    RunFigures figures;
    figures.ate_m = ate_m[i];
    figures.false_loops = 0.0;
    result.runs.push_back({result.plan.runs[i], figures, ""});
  }
  result.others.push_back({"ORB <3>", "onechair", 1, 0.1, ""});
  result.facts.emplace_back("detector", "none");
  return result;
}

}  // namespace cslam::test
