// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/loop_sides.h"

#include <algorithm>
#include <utility>

namespace cslam {

std::vector<std::uint8_t> Neighbourhood(const MapView& map, const Keyframe& keyframe,
                                        int min_shared_points, int min_keyframes_apart) {
  std::vector<std::uint8_t> is_near(map.num_keyframe_ids(), 0);
  is_near[keyframe.id.index()] = 1;
  for (const CovisibleKeyframe& first : keyframe.covisible) {
    is_near[first.id.index()] = 1;
    if (first.shared_points < min_shared_points) continue;
    for (const CovisibleKeyframe& second : map.FindKeyframe(first.id)->covisible) {
      if (second.shared_points >= min_shared_points) is_near[second.id.index()] = 1;
    }
  }
  const auto apart = static_cast<std::size_t>(min_keyframes_apart);
  const std::size_t at = keyframe.id.index();
  for (std::size_t i = at - std::min(at, apart - 1); i < std::min(at + apart, is_near.size());
       ++i) {
    const Keyframe* other = map.FindKeyframe(KeyframeId(static_cast<std::uint32_t>(i)));
    if (other != nullptr && other->map == keyframe.map) is_near[i] = 1;
  }
  return is_near;
}

double PathLength(const MapView& map, const Keyframe& a, const Keyframe& b) {
  const auto [first, last] = std::minmax(a.id, b.id);
  double length = 0.0;
  const Keyframe* previous = nullptr;
  for (std::uint32_t i = first.value(); i <= last.value(); ++i) {
    const Keyframe* keyframe = map.FindKeyframe(KeyframeId(i));
    if (keyframe == nullptr || keyframe->map != a.map) continue;
    if (previous != nullptr) {
      length +=
          (keyframe->T_world_camera.translation - previous->T_world_camera.translation).norm();
    }
    previous = keyframe;
  }
  return length;
}

std::optional<MapTransition> TransitionBetween(const MapView& map, MapId a, MapId b) {
  std::vector<const Keyframe*> keyframes;
  for (const KeyframeId id : map.Keyframes()) {
    const Keyframe& keyframe = *map.FindKeyframe(id);
    if (keyframe.map == a || keyframe.map == b) keyframes.push_back(&keyframe);
  }
  std::stable_sort(keyframes.begin(), keyframes.end(), [&](const Keyframe* x, const Keyframe* y) {
    return std::pair(map.SessionOf(x->id), x->data->stamp) <
           std::pair(map.SessionOf(y->id), y->data->stamp);
  });
  std::optional<MapTransition> best;
  for (std::size_t i = 1; i < keyframes.size(); ++i) {
    const Keyframe* first = keyframes[i - 1];
    const Keyframe* second = keyframes[i];
    if (first->map == second->map || map.SessionOf(first->id) != map.SessionOf(second->id)) {
      continue;
    }
    const double time_s = SecondsBetween(second->data->stamp, first->data->stamp);
    if (best && best->time_s <= time_s) continue;
    if (first->map != a) std::swap(first, second);
    best = MapTransition{first->id, second->id, time_s};
  }
  return best;
}

LoopSides SidesOf(const MapView& map, KeyframeId fixed_end, KeyframeId moving_end,
                  int keyframes_per_side) {
  const auto limit = static_cast<std::size_t>(keyframes_per_side - 1);
  LoopSides sides{.fixed = {fixed_end}, .moving = {moving_end}};
  for (const CovisibleKeyframe& n : map.Neighbours(fixed_end, 1, limit)) {
    if (n.id != moving_end) sides.fixed.push_back(n.id);
  }
  for (const CovisibleKeyframe& n : map.Neighbours(moving_end, 1, limit)) {
    if (std::find(sides.fixed.begin(), sides.fixed.end(), n.id) == sides.fixed.end()) {
      sides.moving.push_back(n.id);
    }
  }
  return sides;
}

std::vector<PlacedDepth> PlacedDepths(const CorrectedView& view,
                                      std::span<const KeyframeId> keyframes) {
  std::vector<PlacedDepth> views;
  for (const KeyframeId id : keyframes) {
    const Keyframe& keyframe = *view.map().FindKeyframe(id);
    views.push_back({keyframe.data->depth_small_mm, view.T_world_camera(keyframe)});
  }
  return views;
}

DepthComparison CompareWithPlace(const MapView& map, KeyframeId place, const PlacedDepth& view,
                                 const Camera& camera, const DepthCheckOptions& options) {
  std::vector<PlacedDepth> seen{
      {map.FindKeyframe(place)->data->depth_small_mm, map.FindKeyframe(place)->T_world_camera}};
  const auto limit = static_cast<std::size_t>(options.keyframes_per_side - 1);
  for (const CovisibleKeyframe& n : map.Neighbours(place, 1, limit)) {
    const Keyframe& keyframe = *map.FindKeyframe(n.id);
    seen.push_back({keyframe.data->depth_small_mm, keyframe.T_world_camera});
  }
  return CompareDepth(seen, {view}, camera, options);
}

std::vector<PointId> UsablePoints(const MapView& map, std::span<const KeyframeId> keyframes) {
  std::vector<PointId> points;
  for (const KeyframeId id : keyframes) {
    for (const PointId point : map.FindKeyframe(id)->points) {
      if (point.valid() && IsUsable(*map.FindPoint(point))) points.push_back(point);
    }
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

}  // namespace cslam
