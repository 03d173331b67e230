// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/culling.h"

#include <limits>

namespace cslam {
namespace {

const Keypoint& KeypointOf(const Map& map, const PointObservation& o) {
  return map.FindKeyframe(o.keyframe)
      ->data->features.keypoints[static_cast<std::size_t>(o.keypoint)];
}

bool IsSeenWellWithout(const Map& map, const MapPoint& point, KeyframeId without, int octave,
                       int num_observers) {
  if (static_cast<int>(point.observations.size()) <= num_observers) return false;
  int others = 0;
  for (const PointObservation& o : point.observations) {
    if (o.keyframe != without && KeypointOf(map, o).octave <= octave + 1) ++others;
  }
  return others >= num_observers;
}

bool IsRedundant(const Map& map, const Keyframe& keyframe, const DepthOptions& depth,
                 const CullingOptions& options) {
  int num_points = 0;
  int num_redundant = 0;
  for (std::size_t i = 0; i < keyframe.points.size(); ++i) {
    if (!keyframe.points[i].valid()) continue;
    const Keypoint& keypoint = keyframe.data->features.keypoints[i];
    if (!keypoint.HasDepth() || static_cast<double>(keypoint.depth_m) > depth.near_depth_m()) {
      continue;
    }
    ++num_points;
    if (IsSeenWellWithout(map, *map.FindPoint(keyframe.points[i]), keyframe.id, keypoint.octave,
                          options.redundant_observers)) {
      ++num_redundant;
    }
  }
  return num_redundant > options.redundant_share * num_points;
}

}  // namespace

PointCulling CullPointsOnProbation(Map& map, const std::vector<PointId>& on_probation,
                                   KeyframeId newest, const CullingOptions& options) {
  PointCulling result;
  for (const PointId id : on_probation) {
    const MapPoint* point = map.FindPoint(id);
    if (point == nullptr) continue;
    const int age = static_cast<int>(newest.value() - point->created_by.value());
    const bool is_rarely_found =
        point->times_found < options.min_found_ratio * point->times_expected;
    const bool is_rarely_seen =
        age >= 2 && static_cast<int>(point->observations.size()) < options.min_observations;
    if (is_rarely_found || is_rarely_seen) {
      map.ErasePoint(id);
      ++result.num_erased;
    } else if (age < options.probation_keyframes) {
      result.still_on_probation.push_back(id);
    }
  }
  return result;
}

int CullRedundantKeyframes(Map& map, KeyframeId newest, const DepthOptions& depth,
                           int min_shared_points, const CullingOptions& options) {
  int culled = 0;
  const auto neighbours =
      map.Neighbours(newest, min_shared_points, std::numeric_limits<std::size_t>::max());
  for (const CovisibleKeyframe& neighbour : neighbours) {
    const Keyframe& keyframe = *map.FindKeyframe(neighbour.id);
    if (!keyframe.parent.valid() || !IsRedundant(map, keyframe, depth, options)) continue;
    map.CullKeyframe(neighbour.id);
    ++culled;
  }
  return culled;
}

}  // namespace cslam
