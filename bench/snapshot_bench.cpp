// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// What it costs to publish a map of many points after an edit the size of a local bundle
// adjustment. The edit pays for cloning what snapshots share, publishing for one pointer per chunk.
#include "cslam/map/map.h"
#include "cslam/map/test_map.h"

#include <benchmark/benchmark.h>

#include <memory>

namespace cslam {
namespace {

constexpr int kPointsPerKeyframe = 250;
constexpr int kObservers = 4;  // keyframes that see a point
constexpr int kFeatures = kPointsPerKeyframe * kObservers;
constexpr std::size_t kBaKeyframes = 20;

// A row of keyframes, each of which makes points that it and the next three see.
std::unique_ptr<Map> MakeMap(int num_points) {
  auto map = std::make_unique<Map>(test::kLevelScales);
  const int num_keyframes = num_points / kPointsPerKeyframe;
  for (int k = 0; k < num_keyframes; ++k) {
    const auto id = static_cast<std::uint32_t>(k);
    map->AddKeyframe(
        test::MakeKeyframe(id, kFeatures, 0.1 * k, k == 0 ? KeyframeId() : KeyframeId(id - 1)));
  }
  for (int k = 0; k < num_keyframes; ++k) {
    for (int i = 0; i < kPointsPerKeyframe; ++i) {
      const PointId point =
          map->AddPoint({0.1 * k, 0.01 * i, 3.0}, KeyframeId(static_cast<std::uint32_t>(k)));
      for (int o = 0; o < kObservers && k + o < num_keyframes; ++o)
        map->AddObservation(point, KeyframeId(static_cast<std::uint32_t>(k + o)),
                            o * kPointsPerKeyframe + i);
      map->RefreshAppearance(point);
    }
  }
  return map;
}

// Moves the newest keyframes and all points they see.
void AdjustNewest(Map& map) {
  const auto keyframes = map.Keyframes();
  const auto first = keyframes.end() - static_cast<std::ptrdiff_t>(kBaKeyframes);
  for (auto id = first; id != keyframes.end(); ++id) {
    map.SetPose(*id, map.FindKeyframe(*id)->T_world_camera);
    const std::vector<PointId> points = map.FindKeyframe(*id)->points;
    for (const PointId point : points) {
      if (!point.valid()) continue;
      map.SetPosition(point, map.FindPoint(point)->p_world);
      map.RefreshGeometry(point);
    }
  }
}

// The bar: under 2 ms at 100,000 points.
void BM_PublishAfterLocalAdjustment(benchmark::State& state) {
  const auto map = MakeMap(static_cast<int>(state.range(0)));
  auto newest = std::make_shared<const MapView>(map->Snapshot());
  for (auto _ : state) {
    state.PauseTiming();
    AdjustNewest(*map);
    state.ResumeTiming();
    newest = std::make_shared<const MapView>(map->Snapshot());  // and the last one is dropped
    benchmark::DoNotOptimize(newest.get());
  }
  state.counters["keyframes"] = static_cast<double>(map->num_keyframes());
  state.counters["points"] = static_cast<double>(map->num_points());
}
BENCHMARK(BM_PublishAfterLocalAdjustment)->Arg(10'000)->Arg(100'000)->Unit(benchmark::kMillisecond);

// The edit with a snapshot held by a reader, so that what it touches is cloned ...
void BM_LocalAdjustmentWhileShared(benchmark::State& state) {
  const auto map = MakeMap(static_cast<int>(state.range(0)));
  auto newest = std::make_shared<const MapView>(map->Snapshot());
  for (auto _ : state) {
    AdjustNewest(*map);
    state.PauseTiming();
    newest = std::make_shared<const MapView>(map->Snapshot());
    state.ResumeTiming();
  }
}
BENCHMARK(BM_LocalAdjustmentWhileShared)->Arg(100'000)->Unit(benchmark::kMillisecond);

// ... and without: the difference is the price of sharing.
void BM_LocalAdjustmentAlone(benchmark::State& state) {
  const auto map = MakeMap(static_cast<int>(state.range(0)));
  for (auto _ : state)
    AdjustNewest(*map);
}
BENCHMARK(BM_LocalAdjustmentAlone)->Arg(100'000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cslam

BENCHMARK_MAIN();
