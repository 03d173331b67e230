// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/best_first_matching.h"

#include <algorithm>

namespace cslam {

std::vector<std::optional<TrackId>> MatchBestFirst(std::vector<BoxOverlap> overlaps,
                                                   std::size_t num_detections) {
  std::stable_sort(overlaps.begin(), overlaps.end(), [](const auto& a, const auto& b) {
    return a.iou != b.iou ? a.iou > b.iou : a.track < b.track;
  });
  std::vector<std::optional<TrackId>> match(num_detections);
  std::vector<TrackId> used;
  for (const BoxOverlap& overlap : overlaps) {
    const bool is_used = std::find(used.begin(), used.end(), overlap.track) != used.end();
    if (match[overlap.detection] || is_used) continue;
    match[overlap.detection] = overlap.track;
    used.push_back(overlap.track);
  }
  return match;
}

}  // namespace cslam
