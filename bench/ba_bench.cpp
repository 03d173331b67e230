// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/optim/test_scene.h"

#include <benchmark/benchmark.h>

namespace cslam {
namespace {

// Noisy, 2 % of the observations wrong, poses a few mm and mrad off, as after tracking.
BaProblem LocalProblem(int num_free, int num_fixed, int num_points) {
  BaProblem problem = test::MakeBaScene({.num_free = num_free,
                                         .num_fixed = num_fixed,
                                         .num_points = num_points,
                                         .observations_per_point = 5},
                                        1.0, 1)
                          .problem;
  for (std::size_t i = 0; i < problem.observations.size(); i += 50) {
    problem.observations[i].uv_px += Eigen::Vector2d(15.0, 10.0);
  }
  return test::Perturbed(problem, 0.003, 0.005, 2);
}

void BM_AdjustBundle(benchmark::State& state, int num_free, int num_fixed, int num_points) {
  const BaProblem problem = LocalProblem(num_free, num_fixed, num_points);
  double iterations = 0.0;
  for (auto _ : state) {
    const BaResult result = AdjustBundle(problem, {});
    benchmark::DoNotOptimize(result.final_cost);
    iterations = result.iterations;
  }
  state.counters["iterations"] = iterations;
}
BENCHMARK_CAPTURE(BM_AdjustBundle, local_small, 8, 8, 1000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_AdjustBundle, local_large, 20, 20, 3000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_AdjustBundle, global, 150, 1, 10000)->Unit(benchmark::kMillisecond);

// The cost of one more iteration: what separates 12 forced ones from 2.
void BM_AdjustBundleIterations(benchmark::State& state) {
  const BaProblem problem = LocalProblem(20, 20, 3000);
  const BundleAdjusterOptions options{.iterations_robust = static_cast<int>(state.range(0)),
                                      .iterations_final = 0,
                                      .function_tolerance = 0.0};
  for (auto _ : state) {
    benchmark::DoNotOptimize(AdjustBundle(problem, options).final_cost);
  }
}
BENCHMARK(BM_AdjustBundleIterations)->Arg(2)->Arg(12)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cslam

BENCHMARK_MAIN();
