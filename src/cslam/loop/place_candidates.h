// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/loop/place_index.h"
#include "cslam/map/map_view.h"

#include <functional>
#include <span>
#include <vector>

namespace cslam {

class OptionList;

// Which keyframes are worth a closer look.
struct CandidateOptions {
  int max_results = 40;
  int max_candidates = 5;
  int min_votes = 8;
};
void Describe(OptionList& list, CandidateOptions& options);

// The places that look most like a frame of these descriptors, best first. is_excluded has to
// exclude what the index holds and the map no longer has.
std::vector<PlaceCandidate> FindPlaces(const MapView& map, const PlaceIndex& index,
                                       std::span<const Descriptor> descriptors,
                                       const std::function<bool(KeyframeId)>& is_excluded,
                                       const CandidateOptions& options);

// Candidates whose neighbours are candidates, too, first: a place is seen by several keyframes.
// Of those that share points only the best is listed before the best of other places.
std::vector<PlaceCandidate> RankPlaces(const MapView& map,
                                       const std::vector<PlaceCandidate>& candidates);

}  // namespace cslam
