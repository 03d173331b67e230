// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/loop/depth_check.h"
#include "cslam/loop/loop_fusion.h"
#include "cslam/map/map_view.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cslam {

// The keyframes that look at what the given one sees: itself, all that share a point with it, those
// that share many with one that shares many, and those inserted just before or after. One flag per
// id.
std::vector<std::uint8_t> Neighbourhood(const MapView& map, const Keyframe& keyframe,
                                        int min_shared_points, int min_keyframes_apart);

// The way between two keyframes of one map, along the keyframes between them.
double PathLength(const MapView& map, const Keyframe& a, const Keyframe& b);

// The two keyframes of different maps, but of one session, between which the least time passed.
struct MapTransition {
  KeyframeId a;
  KeyframeId b;
  double time_s = 0.0;
};
std::optional<MapTransition> TransitionBetween(const MapView& map, MapId a, MapId b);

// Keyframes on the two sides of a loop: its ends and their best neighbours, each on one side only.
struct LoopSides {
  std::vector<KeyframeId> fixed;
  std::vector<KeyframeId> moving;
};
LoopSides SidesOf(const MapView& map, KeyframeId fixed_end, KeyframeId moving_end,
                  int keyframes_per_side);

// The depth images of keyframes where they will be after a correction.
std::vector<PlacedDepth> PlacedDepths(const CorrectedView& view,
                                      std::span<const KeyframeId> keyframes);

// How the depth a camera measured fits that of a keyframe and its best neighbours.
DepthComparison CompareWithPlace(const MapView& map, KeyframeId place, const PlacedDepth& view,
                                 const Camera& camera, const DepthCheckOptions& options);

// The usable points the keyframes see, by id.
std::vector<PointId> UsablePoints(const MapView& map, std::span<const KeyframeId> keyframes);

}  // namespace cslam
