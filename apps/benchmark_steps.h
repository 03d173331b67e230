// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/benchmark/plan.h"

#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "render_sequences.h"

namespace cslam {

enum class BenchmarkDetector { kNone, kNetwork, kPerfect };

// What the benchmark command was given.
struct BenchmarkArguments {
  BenchmarkRequest request;
  RenderArguments render;  // size, rate, look, jobs; names, folders and seeds are the plan's
  BenchmarkDetector detector = BenchmarkDetector::kNetwork;
  std::string model;                     // empty: the default one
  std::string rate = "max";              // of threaded runs
  std::vector<std::string> run_options;  // further words for each run: --set and so on
  std::set<int> classes;                 // COCO, to be judged; empty: all
  // Trajectories of other systems: label, folder.
  std::vector<std::pair<std::string, std::filesystem::path>> others;
  bool is_confirmed = false;
};

// Does it, as far as it is not done yet. Returns the exit code. Throws Error.
int RunBenchmark(const BenchmarkArguments& arguments);

}  // namespace cslam
