// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/place_candidates.h"

#include "cslam/util/options.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace cslam {
namespace {

constexpr int kMinSharedPoints = 15;  // with fewer, keyframes hardly see the same
constexpr std::size_t kMaxNeighbours = 10;

}  // namespace

void Describe(OptionList& list, CandidateOptions& o) {
  list.Add("max_results", o.max_results, {1, 1000}, "keyframes",
           "Keyframes asked of the place index; they are ranked by place.");
  list.Add("max_candidates", o.max_candidates, {1, 100}, "keyframes",
           "Of those, the best places that are verified.");
  list.Add("min_votes", o.min_votes, {1, 10'000}, "features",
           "Keyframes in which fewer features were recognised are not verified.");
}

std::vector<PlaceCandidate> FindPlaces(const MapView& map, const PlaceIndex& index,
                                       std::span<const Descriptor> descriptors,
                                       const std::function<bool(KeyframeId)>& is_excluded,
                                       const CandidateOptions& options) {
  std::vector<PlaceCandidate> places =
      index.Query(descriptors, is_excluded, static_cast<std::size_t>(options.max_results));
  std::erase_if(places, [&](const auto& place) { return place.votes < options.min_votes; });
  places = RankPlaces(map, places);
  places.resize(std::min(places.size(), static_cast<std::size_t>(options.max_candidates)));
  return places;
}

std::vector<PlaceCandidate> RankPlaces(const MapView& map,
                                       const std::vector<PlaceCandidate>& candidates) {
  std::vector<double> score_of(map.num_keyframe_ids(), 0.0);
  for (const PlaceCandidate& candidate : candidates)
    score_of[candidate.keyframe.index()] = candidate.score;
  std::vector<std::pair<double, PlaceCandidate>> ranked;  // by the score of its surroundings
  for (const PlaceCandidate& candidate : candidates) {
    double score = candidate.score;
    for (const auto& n : map.Neighbours(candidate.keyframe, kMinSharedPoints, kMaxNeighbours))
      score += score_of[n.id.index()];
    ranked.emplace_back(score, candidate);
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });

  std::vector<PlaceCandidate> first, later;
  std::vector<std::uint8_t> is_covered(map.num_keyframe_ids(), 0);
  for (const auto& [score, candidate] : ranked) {
    const KeyframeId id = candidate.keyframe;
    (is_covered[id.index()] == 0 ? first : later).push_back(candidate);
    is_covered[id.index()] = 1;
    for (const auto& n : map.Neighbours(id, kMinSharedPoints, kMaxNeighbours))
      is_covered[n.id.index()] = 1;
  }
  first.insert(first.end(), later.begin(), later.end());
  return first;
}

}  // namespace cslam
