// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// What it costs to keep a map on disk: 1,000 features and a reduced depth image per keyframe, 250
// points made by each. The bar: 1,000 keyframes are saved and loaded in under 2 s each.
#include "cslam/atlas_io/map_file.h"
#include "cslam/atlas_io/test_atlas.h"

#include <benchmark/benchmark.h>

#include <filesystem>
#include <memory>

namespace cslam {
namespace {

constexpr int kFeatures = 1000;

std::filesystem::path BenchFile() {
  return std::filesystem::temp_directory_path() / "cslam_map_file_bench.map";
}

std::unique_ptr<Map> MakeMap(benchmark::State& state) {
  auto map = std::make_unique<Map>(test::kLevelScales);
  test::AddRowOfKeyframes(*map, MapId(0), static_cast<int>(state.range(0)), kFeatures, {160, 120});
  return map;
}

void Report(benchmark::State& state, const MapView& map) {
  state.counters["points"] = static_cast<double>(map.num_points());
  state.counters["megabytes"] = 1e-6 * static_cast<double>(std::filesystem::file_size(BenchFile()));
}

void BM_SaveMap(benchmark::State& state) {
  const auto map = MakeMap(state);
  for (auto _ : state)
    SaveMap(BenchFile(), *map, test::MakeMapFileInfo());
  Report(state, *map);
  std::filesystem::remove(BenchFile());
}
BENCHMARK(BM_SaveMap)->Arg(100)->Arg(1000)->UseRealTime()->Unit(benchmark::kMillisecond);

void BM_LoadMap(benchmark::State& state) {
  const auto map = MakeMap(state);
  SaveMap(BenchFile(), *map, test::MakeMapFileInfo());
  for (auto _ : state) {
    const SavedMap saved = LoadMap(BenchFile());
    state.PauseTiming();
    const std::string difference = test::FindDifference(*map, saved.map);
    if (!difference.empty()) state.SkipWithError(difference.c_str());
    state.ResumeTiming();
  }
  Report(state, *map);
  std::filesystem::remove(BenchFile());
}
BENCHMARK(BM_LoadMap)->Arg(100)->Arg(1000)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cslam

BENCHMARK_MAIN();
