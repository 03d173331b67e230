// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/fusion.h"

#include "cslam/vision/matching.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace cslam {
namespace {

// Keyframes of the same map that looked the same way from nearby, the nearest first.
std::vector<KeyframeId> NearbyKeyframes(const Map& map, KeyframeId keyframe,
                                        const std::set<KeyframeId>& excluded,
                                        const FusionOptions& options) {
  const Keyframe& center = *map.FindKeyframe(keyframe);
  const Eigen::Vector3d view = center.T_world_camera.rotation * Eigen::Vector3d::UnitZ();
  const double min_cosine = std::cos(options.nearby_angle_deg * std::numbers::pi / 180.0);
  std::vector<std::pair<double, KeyframeId>> nearby;
  for (const KeyframeId id : map.Keyframes()) {
    const Keyframe& other = *map.FindKeyframe(id);
    if (other.map != center.map || excluded.contains(id)) continue;
    const double distance =
        (other.T_world_camera.translation - center.T_world_camera.translation).norm();
    const double cosine = view.dot(other.T_world_camera.rotation * Eigen::Vector3d::UnitZ());
    if (distance <= options.nearby_distance_m && cosine >= min_cosine) {
      nearby.emplace_back(distance, id);
    }
  }
  std::sort(nearby.begin(), nearby.end());
  std::vector<KeyframeId> ids;
  for (const auto& [distance, id] : nearby) {
    if (static_cast<int>(ids.size()) == options.nearby_keyframes) break;
    ids.push_back(id);
  }
  return ids;
}

std::vector<KeyframeId> SelectTargets(const Map& map, KeyframeId keyframe, int min_shared_points,
                                      const FusionOptions& options) {
  std::vector<KeyframeId> targets;
  std::set<KeyframeId> seen{keyframe};
  const auto first =
      map.Neighbours(keyframe, min_shared_points, static_cast<std::size_t>(options.neighbours));
  for (const CovisibleKeyframe& neighbour : first) {
    if (seen.insert(neighbour.id).second) targets.push_back(neighbour.id);
  }
  for (const CovisibleKeyframe& neighbour : first) {
    const auto second = map.Neighbours(neighbour.id, min_shared_points,
                                       static_cast<std::size_t>(options.second_neighbours));
    for (const CovisibleKeyframe& n : second) {
      if (seen.insert(n.id).second) targets.push_back(n.id);
    }
  }
  const auto nearby = NearbyKeyframes(map, keyframe, seen, options);
  targets.insert(targets.end(), nearby.begin(), nearby.end());
  return targets;
}

// Where a point should appear in the keyframe; nullopt when it cannot be recognised there.
std::optional<ProjectionQuery> Predict(const MapPoint& point, const Keyframe& keyframe,
                                       const Se3& T_camera_world, const Camera& camera,
                                       const ImageBounds& bounds, const DepthOptions& depth,
                                       const MeasurementModel& model,
                                       const FusionOptions& options) {
  const Eigen::Vector3d p_camera = T_camera_world * point.p_world;
  if (p_camera.z() <= 0.05) return std::nullopt;
  const Eigen::Vector2d uv = Project(camera, p_camera);
  if (!bounds.Contains(uv)) return std::nullopt;
  const Eigen::Vector3d offset = point.p_world - keyframe.T_world_camera.translation;
  const double distance = offset.norm();
  if (distance < 0.8 * static_cast<double>(point.min_distance_m) ||
      distance > 1.2 * static_cast<double>(point.max_distance_m) ||
      offset.dot(point.normal.cast<double>()) < 0.5 * distance) {
    return std::nullopt;
  }
  const int octave = model.PredictOctave(static_cast<double>(point.max_distance_m) / distance);
  ProjectionQuery query;
  query.uv_px = uv.cast<float>();
  query.disparity_px = static_cast<float>(camera.fx * depth.baseline_m / p_camera.z());
  query.radius_px = static_cast<float>(options.radius_px * model.scale(octave));
  query.min_octave = octave - 1;
  query.max_octave = octave;
  query.descriptor = point.descriptor;
  return query;
}

// chi2 gate on where the point was found.
bool IsConsistent(const ProjectionQuery& query, const Keypoint& keypoint,
                  const MeasurementModel& model) {
  const Eigen::Vector2f error = query.uv_px - keypoint.uv_px;
  double chi2 = static_cast<double>(error.squaredNorm()) * model.information_px(keypoint.octave);
  if (!keypoint.HasDepth()) return chi2 < 5.991;  // chi2, 2 dof, 95 %
  const auto d = static_cast<double>(query.disparity_px - keypoint.disparity_px);
  chi2 += d * d * model.information_disparity(keypoint.octave);
  return chi2 < 7.815;  // chi2, 3 dof, 95 %
}

int FuseInto(Map& map, KeyframeId id, const std::vector<PointId>& points, const Camera& camera,
             const ImageBounds& bounds, const DepthOptions& depth, const MeasurementModel& model,
             const FusionOptions& options) {
  const Keyframe& keyframe = *map.FindKeyframe(id);
  const Se3 T_camera_world = keyframe.T_world_camera.Inverse();
  std::vector<PointId> candidates;
  std::vector<ProjectionQuery> queries;
  for (const PointId point_id : points) {
    const MapPoint* point = map.FindPoint(point_id);
    if (point == nullptr || !IsUsable(*point)) continue;
    const auto& seen = point->observations;
    const bool is_seen =
        std::any_of(seen.begin(), seen.end(), [&](const auto& o) { return o.keyframe == id; });
    if (is_seen) continue;
    const auto query =
        Predict(*point, keyframe, T_camera_world, camera, bounds, depth, model, options);
    if (!query) continue;
    candidates.push_back(point_id);
    queries.push_back(*query);
  }
  const std::shared_ptr<const KeyframeData> data = keyframe.data;
  const auto matches =
      MatchByProjection(data->features, queries, {.max_distance = options.match_distance});
  int fused = 0;
  for (const Match& match : matches) {
    const auto q = static_cast<std::size_t>(match.query);
    const auto k = static_cast<std::size_t>(match.keypoint);
    if (!IsConsistent(queries[q], data->features.keypoints[k], model)) continue;
    const PointId point = candidates[q];
    const PointId present = map.FindKeyframe(id)->points[k];
    if (map.FindPoint(point) == nullptr) continue;  // fused away a moment ago
    if (!present.valid()) {
      if (!map.AddObservation(point, id, match.keypoint)) continue;
      map.RefreshAppearance(point);
    } else {
      const bool keep_present =
          map.FindPoint(present)->observations.size() >= map.FindPoint(point)->observations.size();
      map.FusePoints(keep_present ? present : point, keep_present ? point : present);
    }
    ++fused;
  }
  return fused;
}

std::vector<PointId> PointsOf(const Map& map, KeyframeId id) {
  std::vector<PointId> points;
  for (const PointId point : map.FindKeyframe(id)->points) {
    if (point.valid()) points.push_back(point);
  }
  return points;
}

}  // namespace

int FuseWithNeighbours(Map& map, KeyframeId keyframe, const Camera& camera,
                       const ImageBounds& bounds, const DepthOptions& depth,
                       const MeasurementModel& model, int min_shared_points,
                       const FusionOptions& options) {
  const auto targets = SelectTargets(map, keyframe, min_shared_points, options);
  int fused = 0;
  for (const KeyframeId target : targets) {
    fused += FuseInto(map, target, PointsOf(map, keyframe), camera, bounds, depth, model, options);
  }
  std::set<PointId> unique;
  std::vector<PointId> candidates;
  for (const KeyframeId target : targets) {
    for (const PointId point : PointsOf(map, target)) {
      if (unique.insert(point).second) candidates.push_back(point);
    }
  }
  fused += FuseInto(map, keyframe, candidates, camera, bounds, depth, model, options);
  return fused;
}

}  // namespace cslam
