// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/optim/test_scene.h"

#include <benchmark/benchmark.h>

namespace cslam {
namespace {

// A tracked frame: noisy matches, one in ten wrong, the start a frame's motion away.
void BM_OptimizePose(benchmark::State& state) {
  test::PoseScene scene = test::MakePoseScene(static_cast<int>(state.range(0)), 1.0, 1);
  Rng rng(1);
  for (std::size_t i = 0; i < scene.observations.size(); i += 10) {
    scene.observations[i].uv_px += Eigen::Vector2d(rng.Uniform(10.0, 40.0), 10.0);
  }
  const Se3 start = scene.T_world_camera * test::RandomMotion(rng, 0.01, 0.02);
  int iterations = 0;
  for (auto _ : state) {
    const PoseSolution solution =
        OptimizePose(scene.camera, test::kBaseline, start, scene.observations, {});
    benchmark::DoNotOptimize(solution.num_inliers);
    iterations = solution.iterations;
  }
  state.counters["iterations"] = iterations;
}
BENCHMARK(BM_OptimizePose)->Arg(100)->Arg(400)->Arg(1000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace cslam

BENCHMARK_MAIN();
