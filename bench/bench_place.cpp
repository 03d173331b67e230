// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// Place index at up to 10,000 keyframes of 400 indexed descriptors each; queries of 1000.
//
// Descriptors of ORB features in pictures cluster: some bits belong together, and many corners look
// alike. So places are made from the features of pictures (a recording in CSLAM_SEQUENCE, else the
// rendered demo), each with bits flipped for good: a corner of its own, near others. What a
// keyframe sees of its place has bits flipped once more, as another view has. Sixteen keyframes in
// a row share a place, as neighbours do.
#include "cslam/io/dataset.h"
#include "cslam/loop/place_index.h"
#include "cslam/sim/test_frames.h"
#include "cslam/util/random.h"
#include "cslam/vision/orb.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <memory>
#include <vector>

namespace cslam {
namespace {

constexpr int kIndexedFeatures = 400;
constexpr int kQueryFeatures = 1000;
constexpr std::uint32_t kKeyframesPerPlace = 16;
constexpr double kPlaceFlips = 0.06;  // share of bits; little, so that places look alike
constexpr double kViewFlips = 0.12;   // median distance of true matches: 30 of 256

std::vector<cv::Mat> Pictures() {
  constexpr std::size_t kPictures = 40;
  std::vector<cv::Mat> pictures;
  if (const char* folder = std::getenv("CSLAM_SEQUENCE")) {
    const auto dataset = OpenDataset(folder);
    for (std::size_t k = 0; k < kPictures; ++k) {
      const LoadResult loaded = dataset->Load(k * dataset->size() / kPictures);
      if (loaded.frame) pictures.push_back(loaded.frame->gray);
    }
    return pictures;
  }
  const auto frames = test::MakeTestFrames({.width = 640, .height = 480}, 60).frames;
  for (const auto& frame : frames)
    pictures.push_back(frame->gray);
  return pictures;
}

const std::vector<std::vector<Descriptor>>& Models() {
  static const auto models = [] {
    std::vector<std::vector<Descriptor>> result;
    OrbExtractor extractor(OrbOptions{});
    for (const cv::Mat& picture : Pictures())
      result.push_back(extractor.Extract(picture).descriptors);
    return result;
  }();
  return models;
}

Descriptor Flipped(Descriptor descriptor, double share, Rng& rng) {
  for (std::size_t word = 0; word < 4; ++word) {
    for (std::size_t bit = 0; bit < 64; ++bit) {
      if (rng.Uniform() < share) descriptor.words[word] ^= std::uint64_t{1} << bit;
    }
  }
  return descriptor;
}

// What keyframe number view sees; the same place for kKeyframesPerPlace in a row.
std::vector<Descriptor> View(std::uint32_t view, int num_features, std::uint64_t purpose) {
  const std::uint32_t place = view / kKeyframesPerPlace;
  const auto& models = Models();
  Rng place_rng(place, 1);
  Rng view_rng(view, 2, purpose);
  std::vector<Descriptor> descriptors;
  for (int i = 0; i < num_features; ++i) {
    const auto& model = models[place_rng.Index(models.size())];
    const Descriptor corner = Flipped(model[place_rng.Index(model.size())], kPlaceFlips, place_rng);
    descriptors.push_back(Flipped(corner, kViewFlips, view_rng));
  }
  return descriptors;
}

const PlaceIndex& IndexOf(std::uint32_t num_keyframes) {
  static std::map<std::uint32_t, std::unique_ptr<PlaceIndex>> indices;
  auto& index = indices[num_keyframes];
  if (index) return *index;
  index = std::make_unique<PlaceIndex>();
  for (std::uint32_t i = 0; i < num_keyframes; ++i)
    index->Add(KeyframeId(i), View(i, kIndexedFeatures, 0));
  return *index;
}

// 400 of the query's 1000 features are of a place in the index, the rest of another place.
std::vector<Descriptor> QueryAt(std::uint32_t view, std::uint32_t elsewhere) {
  std::vector<Descriptor> query = View(view, kIndexedFeatures, 1);
  const auto rest = View(elsewhere, kQueryFeatures - kIndexedFeatures, 1);
  query.insert(query.end(), rest.begin(), rest.end());
  return query;
}

void BM_PlaceQuery(benchmark::State& state) {
  const auto num_keyframes = static_cast<std::uint32_t>(state.range(0));
  const PlaceIndex& index = IndexOf(num_keyframes);
  std::vector<std::vector<Descriptor>> queries;
  std::vector<std::uint32_t> places;
  for (std::uint32_t k = 0; k < 20; ++k) {
    const std::uint32_t view = (k * 7919U + 5U) % num_keyframes;
    queries.push_back(QueryAt(view, 1'000'000U + 100U * k));
    places.push_back(view / kKeyframesPerPlace);
  }
  std::size_t k = 0;
  std::size_t num_asked = 0;
  std::size_t num_right = 0;
  for (auto _ : state) {
    const auto found = index.Query(queries[k % queries.size()], {}, 10);
    ++num_asked;
    if (!found.empty() &&
        found.front().keyframe.value() / kKeyframesPerPlace == places[k % places.size()]) {
      ++num_right;
    }
    ++k;
  }
  state.counters["right_first"] = static_cast<double>(num_right) / static_cast<double>(num_asked);
  state.counters["KB_per_keyframe"] =
      static_cast<double>(index.MemoryBytes()) / 1024.0 / static_cast<double>(num_keyframes);
}
BENCHMARK(BM_PlaceQuery)->Arg(100)->Arg(1000)->Arg(10'000)->Unit(benchmark::kMillisecond);

// One keyframe more, and gone again, at so many.
void BM_PlaceAddRemove(benchmark::State& state) {
  PlaceIndex index = IndexOf(static_cast<std::uint32_t>(state.range(0)));
  const KeyframeId id(static_cast<std::uint32_t>(state.range(0)));
  const auto descriptors = View(id.value(), kIndexedFeatures, 0);
  for (auto _ : state) {
    index.Add(id, descriptors);
    index.Remove(id);
  }
}
BENCHMARK(BM_PlaceAddRemove)->Arg(1000)->Arg(10'000)->Unit(benchmark::kMillisecond);

void BM_PlaceStart(benchmark::State& state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(PlaceIndex());
}
BENCHMARK(BM_PlaceStart)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cslam

BENCHMARK_MAIN();
