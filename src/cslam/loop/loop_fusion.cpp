// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/loop_fusion.h"

#include "cslam/vision/matching.h"

#include <algorithm>
#include <map>
#include <optional>

namespace cslam {
namespace {

bool IsSeenBy(const MapPoint& point, KeyframeId keyframe) {
  return std::any_of(point.observations.begin(), point.observations.end(),
                     [&](const PointObservation& o) { return o.keyframe == keyframe; });
}

// Where a point should appear; nullopt when it cannot be recognised there.
std::optional<ProjectionQuery> Predict(const MapPoint& point, const Eigen::Vector3d& p_camera,
                                       const PlaceSensor& sensor,
                                       const LoopFusionOptions& options) {
  constexpr double kNearestM = 0.05;
  if (p_camera.z() <= kNearestM) return std::nullopt;
  const Eigen::Vector2d uv = Project(sensor.camera, p_camera);
  if (!sensor.bounds.Contains(uv)) return std::nullopt;
  constexpr double kSlack = 1.2;  // one pyramid level
  const double distance = p_camera.norm();
  const auto max_distance = static_cast<double>(point.max_distance_m);
  if (kSlack * distance < static_cast<double>(point.min_distance_m) ||
      distance > kSlack * max_distance) {
    return std::nullopt;
  }
  const int octave = sensor.model.PredictOctave(max_distance / distance);
  ProjectionQuery query;
  query.uv_px = uv.cast<float>();
  query.radius_px = static_cast<float>(options.radius_px * sensor.model.scale(octave));
  query.min_octave = octave - 1;
  query.max_octave = octave + 1;
  query.descriptor = point.descriptor;
  return query;
}

struct Sightings {
  std::vector<PointId> points;
  std::vector<Match> matches;  // Match::query indexes points
};

Sightings FindPoints(const CorrectedView& view, const Keyframe& keyframe,
                     std::span<const PointId> points, const PlaceSensor& sensor,
                     const LoopFusionOptions& options) {
  const Se3 T_camera_world = view.T_world_camera(keyframe).Inverse();
  Sightings sightings;
  std::vector<ProjectionQuery> queries;
  for (const PointId id : points) {
    const MapPoint& point = *view.map().FindPoint(id);
    if (IsSeenBy(point, keyframe.id)) continue;
    const auto query = Predict(point, T_camera_world * view.p_world(point), sensor, options);
    if (!query) continue;
    sightings.points.push_back(id);
    queries.push_back(*query);
  }
  const FrameFeatures& features = keyframe.data->features;
  std::vector<std::uint8_t> is_unusable;
  is_unusable.reserve(features.size());
  for (const KeypointSemantics& s : features.semantics)
    is_unusable.push_back(s.label == KeypointLabel::kStatic ? 0 : 1);
  sightings.matches =
      MatchByProjection(features, queries, {.max_distance = options.match_distance}, is_unusable);
  return sightings;
}

}  // namespace

CorrectedView::CorrectedView(const MapView& map, std::span<const KeyframeMove> moves)
    : map_(map), moves_(map.num_keyframe_ids()) {
  for (const KeyframeMove& move : moves)
    moves_[move.keyframe.index()] = move.T_new_old;
}

Se3 CorrectedView::T_world_camera(const Keyframe& keyframe) const {
  return moves_[keyframe.id.index()] * keyframe.T_world_camera;
}

Eigen::Vector3d CorrectedView::p_world(const MapPoint& point) const {
  return moves_[point.reference.index()] * point.p_world;
}

PointRecall RecallPoints(const CorrectedView& view, KeyframeId keyframe,
                         std::span<const PointId> points, const PlaceSensor& sensor,
                         const LoopFusionOptions& options) {
  const Sightings sightings =
      FindPoints(view, *view.map().FindKeyframe(keyframe), points, sensor, options);
  return {static_cast<int>(sightings.points.size()), static_cast<int>(sightings.matches.size())};
}

LoopFusions FindFusions(const CorrectedView& view, std::span<const KeyframeId> moving_side,
                        std::span<const PointId> points_of_fixed_side, const PlaceSensor& sensor,
                        const LoopFusionOptions& options) {
  LoopFusions fusions;
  std::map<PointId, std::map<PointId, int>> votes;  // moving side's point -> fixed side's
  for (const KeyframeId id : moving_side) {
    const Keyframe& keyframe = *view.map().FindKeyframe(id);
    const Sightings sightings = FindPoints(view, keyframe, points_of_fixed_side, sensor, options);
    for (const Match& match : sightings.matches) {
      const PointId point = sightings.points[static_cast<std::size_t>(match.query)];
      const PointId present = keyframe.points[static_cast<std::size_t>(match.keypoint)];
      if (present.valid()) {
        ++votes[present][point];
      } else {
        fusions.found.push_back({point, id, match.keypoint});
      }
    }
  }
  for (const auto& [drop, keeps] : votes) {
    const auto best =
        std::max_element(keeps.begin(), keeps.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    fusions.pairs.push_back({best->first, drop});
  }
  return fusions;
}

}  // namespace cslam
