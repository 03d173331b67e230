// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/overlap_check.h"

#include "cslam/loop/loop_sides.h"

#include <fmt/core.h>

#include <algorithm>
#include <numbers>
#include <vector>

namespace cslam {
namespace {

std::vector<KeyframeId> KeyframesOf(const MapView& map, MapId id) {
  std::vector<KeyframeId> keyframes = map.Keyframes();
  std::erase_if(keyframes, [&](KeyframeId k) { return map.FindKeyframe(k)->map != id; });
  return keyframes;
}

// Evenly over time.
std::vector<KeyframeId> Thin(const std::vector<KeyframeId>& all, std::size_t max_count) {
  if (all.size() <= max_count) return all;
  std::vector<KeyframeId> kept;
  for (std::size_t i = 0; i < max_count; ++i)
    kept.push_back(all[i * all.size() / max_count]);
  return kept;
}

// The keyframe that looks from nearest in the same direction; invalid if none does.
KeyframeId FindCompanion(const CorrectedView& view, KeyframeId id,
                         const std::vector<KeyframeId>& others,
                         const OverlapCheckOptions& options) {
  const Se3 T_world_camera = view.T_world_camera(*view.map().FindKeyframe(id));
  KeyframeId best;
  double best_m = options.max_distance_m;
  for (const KeyframeId other : others) {
    const PoseDifference d =
        Difference(T_world_camera, view.T_world_camera(*view.map().FindKeyframe(other)));
    if (d.distance_m > best_m || d.angle_rad > options.max_angle_deg * std::numbers::pi / 180.0) {
      continue;
    }
    best = other;
    best_m = d.distance_m;
  }
  return best;
}

}  // namespace

OverlapComparison CompareOverlap(const CorrectedView& view, MapId moving, MapId fixed,
                                 const PlaceSensor& sensor, const LoopFusionOptions& fusion,
                                 const OverlapCheckOptions& options) {
  OverlapComparison comparison;
  const std::vector<KeyframeId> others = KeyframesOf(view.map(), fixed);
  const auto max_count = static_cast<std::size_t>(options.max_keyframes);
  for (const KeyframeId id : Thin(KeyframesOf(view.map(), moving), max_count)) {
    const KeyframeId companion = FindCompanion(view, id, others, options);
    if (!companion.valid()) continue;
    const PointRecall recall =
        RecallPoints(view, id, UsablePoints(view.map(), {&companion, 1}), sensor, fusion);
    if (recall.num_expected < options.min_expected) continue;
    const bool agrees = recall.num_found >= options.min_found_share * recall.num_expected;
    ++(agrees ? comparison.num_agreeing : comparison.num_contradicting);
  }
  return comparison;
}

std::string WhyContradicted(const OverlapComparison& overlap, const OverlapCheckOptions& options) {
  if (overlap.num_contradicting <= options.max_contradicting * overlap.num_compared()) return {};
  return fmt::format("{} of {} keyframes see something else there", overlap.num_contradicting,
                     overlap.num_compared());
}

}  // namespace cslam
