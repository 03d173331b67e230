// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/semantics/nms.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cslam {
namespace {

// Far more than a frame holds at any sensible threshold; bounds the quadratic loop below when a
// broken network calls everything an object.
constexpr std::size_t kMaxCandidates = 3000;

bool IsUsable(const Detection& detection) {
  const Box& box = detection.box;
  return std::isfinite(detection.score) && std::isfinite(box.x_min) && std::isfinite(box.y_min) &&
         std::isfinite(box.x_max) && std::isfinite(box.y_max) && !box.empty();
}

}  // namespace

std::vector<Detection> SuppressNonMaxima(std::vector<Detection> candidates, double max_iou,
                                         std::size_t max_detections) {
  std::erase_if(candidates, [](const Detection& d) { return !IsUsable(d); });
  std::ranges::stable_sort(candidates, std::ranges::greater{}, &Detection::score);
  if (candidates.size() > kMaxCandidates) candidates.resize(kMaxCandidates);
  std::vector<Detection> kept;
  for (Detection& candidate : candidates) {
    if (kept.size() >= max_detections) break;
    const bool is_covered = std::ranges::any_of(kept, [&](const Detection& better) {
      return better.class_id == candidate.class_id && Iou(better.box, candidate.box) > max_iou;
    });
    if (!is_covered) kept.push_back(std::move(candidate));
  }
  return kept;
}

}  // namespace cslam
