// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/benchmark/summary.h"

#include "benchmark_steps.h"

namespace cslam {

// Holds the runs that are there against the truth; what was judged before is taken as it was. Ends
// early, with fewer runs, if the user asks for it.
BenchmarkResult JudgeRuns(const BenchmarkArguments& arguments, const BenchmarkPlan& plan);

// Writes report.md, report.json and, with drawings of each sequence's typical runs, report.html.
void WriteReports(const BenchmarkArguments& arguments, const BenchmarkResult& result);

}  // namespace cslam
