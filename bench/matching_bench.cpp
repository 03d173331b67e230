// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/vision/matching.h"
#include "cslam/vision/test_features.h"

#include <benchmark/benchmark.h>

#include <numeric>

namespace cslam {
namespace {

// A frame of 1000 keypoints on eight levels.
FrameFeatures MakeFrame(std::uint64_t seed) {
  Rng rng(seed);
  std::vector<test::Feature> list;
  for (int i = 0; i < 1000; ++i) {
    list.push_back({.u = static_cast<float>(rng.Uniform(20.0, 620.0)),
                    .v = static_cast<float>(rng.Uniform(20.0, 460.0)),
                    .descriptor = test::RandomDescriptor(rng),
                    .octave = static_cast<int>(rng.Index(8))});
  }
  return test::MakeFeatures(list);
}

// The search of the local map: as many points as range(0), within 15 px.
void BM_MatchByProjection(benchmark::State& state) {
  const FrameFeatures frame = MakeFrame(1);
  Rng rng(2);
  std::vector<ProjectionQuery> queries(static_cast<std::size_t>(state.range(0)));
  for (ProjectionQuery& query : queries) {
    const std::size_t i = rng.Index(frame.size());
    query.uv_px = frame.keypoints[i].uv_px + Eigen::Vector2f(3.0F, -2.0F);
    query.radius_px = 15.0F;
    query.min_octave = frame.keypoints[i].octave - 1;
    query.max_octave = frame.keypoints[i].octave;
    query.descriptor = frame.descriptors[i];
  }
  const MatchOptions options{.max_distance = 100, .max_ratio = 0.8};
  for (auto _ : state)
    benchmark::DoNotOptimize(MatchByProjection(frame, queries, options));
}
BENCHMARK(BM_MatchByProjection)->Arg(500)->Arg(2000)->Unit(benchmark::kMicrosecond);

// The fallback without a prediction: 300 points of the reference keyframe against all keypoints.
void BM_MatchByDescriptor(benchmark::State& state) {
  const FrameFeatures a = MakeFrame(1);
  const FrameFeatures b = MakeFrame(2);
  std::vector<int> with_point(300);
  std::vector<int> all(b.size());
  std::iota(with_point.begin(), with_point.end(), 0);
  std::iota(all.begin(), all.end(), 0);
  const MatchOptions options{.max_distance = 50, .max_ratio = 0.7, .check_rotation = true};
  for (auto _ : state)
    benchmark::DoNotOptimize(MatchByDescriptor(a, with_point, b, all, options));
}
BENCHMARK(BM_MatchByDescriptor)->Unit(benchmark::kMicrosecond);

void BM_MedoidIndex(benchmark::State& state) {
  Rng rng(3);
  std::vector<Descriptor> descriptors;
  for (std::int64_t i = 0; i < state.range(0); ++i)
    descriptors.push_back(test::RandomDescriptor(rng));
  for (auto _ : state)
    benchmark::DoNotOptimize(MedoidIndex(descriptors));
}
BENCHMARK(BM_MedoidIndex)->Arg(5)->Arg(20)->Unit(benchmark::kNanosecond);

}  // namespace
}  // namespace cslam

BENCHMARK_MAIN();
