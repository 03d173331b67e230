// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/tracking/pose_search.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace cslam {
namespace {

constexpr std::size_t Index(int i) {
  return static_cast<std::size_t>(i);
}

std::vector<PointId> PointsOf(const Keyframe& keyframe) {
  std::vector<PointId> points;
  for (const PointId id : keyframe.points) {
    if (id.valid()) points.push_back(id);
  }
  return points;
}

// Who walks into the picture brings many points that are all new and all move alike: points that
// have been seen from many keyframes have more say.
double TrustIn(std::size_t num_views, const TrackerOptions& options) {
  return std::min(1.0, std::max(1.0, static_cast<double>(num_views)) / options.full_trust_views);
}

Landmark MapLandmark(const MapPoint& point, const TrackerOptions& options) {
  return {Landmark::Kind::kMapPoint, point.id, !IsUsable(point), point.p_world,
          TrustIn(point.observations.size(), options)};
}

int CountUsable(const MapView& map, const std::vector<PointId>& points) {
  return static_cast<int>(std::count_if(points.begin(), points.end(), [&](PointId id) {
    const MapPoint* point = id.valid() ? map.FindPoint(id) : nullptr;
    return point != nullptr && IsUsable(*point);
  }));
}

}  // namespace

// Arrays of equal length.
struct PoseSearch::LastSeen {
  std::vector<Landmark> landmarks;
  std::vector<ProjectionQuery> queries;
};

PoseSearch::PoseSearch(const Camera& camera, const TrackerOptions& options)
    : camera_(camera),
      bounds_(UndistortedBounds(camera)),
      options_(options),
      model_(LevelScales(options.orb), options.depth.disparity_sigma_px) {}

std::optional<PoseEstimate> PoseSearch::FromMotion(const FrameFeatures& features,
                                                   const MapView& map, const LastFrame& last,
                                                   const PosePrediction& prediction) const {
  LastSeen seen = PredictLast(map, last, prediction);
  const MatchOptions match_options{
      .max_distance = options_.local_map.match_distance, .max_ratio = 0.9, .check_rotation = true};
  auto found = MatchByProjection(features, seen.queries, match_options);
  if (static_cast<int>(found.size()) < options_.min_last_frame_matches) {
    for (ProjectionQuery& query : seen.queries)
      query.radius_px *= 2.0F;
    found = MatchByProjection(features, seen.queries, match_options);
  }
  if (static_cast<int>(found.size()) < options_.min_last_frame_matches) return std::nullopt;
  FrameMatches matches(features.size());
  for (const Match& match : found)
    matches[Index(match.keypoint)] = seen.landmarks[Index(match.query)];
  return Estimate(features, std::move(matches), prediction.T_world_camera, Provisional::kUse);
}

PoseSearch::LastSeen PoseSearch::PredictLast(const MapView& map, const LastFrame& last,
                                             const PosePrediction& prediction) const {
  const Se3 T_predicted_world = prediction.T_world_camera.Inverse();
  const FrameFeatures& features = last.data->features;
  const bool use_held_back = CountUsable(map, last.points) < options_.use_held_back_below;
  LastSeen seen;
  for (std::size_t i = 0; i < features.size(); ++i) {
    const auto landmark = LastLandmark(map, last, i, prediction.T_world_last, use_held_back);
    if (!landmark) continue;
    auto query = QueryFor(features.keypoints[i], T_predicted_world * landmark->p_world);
    if (!query) continue;
    query->descriptor = features.descriptors[i];
    seen.landmarks.push_back(*landmark);
    seen.queries.push_back(*query);
  }
  return seen;
}

// What keypoint i of the last frame is of: a map point or a near depth reading.
std::optional<Landmark> PoseSearch::LastLandmark(const MapView& map, const LastFrame& last,
                                                 std::size_t i, const Se3& T_world_last,
                                                 bool use_held_back) const {
  const auto id = last.points[i].valid() ? map.Resolve(last.points[i]) : std::nullopt;
  if (id) {
    const MapPoint& point = *map.FindPoint(*id);
    if (!IsUsable(point) && !use_held_back) return std::nullopt;
    return MapLandmark(point, options_);
  }
  const Keypoint& keypoint = last.data->features.keypoints[i];
  if (!IsNear(keypoint, options_.depth)) return std::nullopt;
  const Eigen::Vector3d p_last =
      Unproject(camera_, keypoint.uv_px.cast<double>(), static_cast<double>(keypoint.depth_m));
  return Landmark{Landmark::Kind::kProvisional, PointId(), false, T_world_last * p_last,
                  TrustIn(0, options_)};
}

// Where a keypoint of the last frame should be now, without its descriptor.
std::optional<ProjectionQuery> PoseSearch::QueryFor(const Keypoint& last,
                                                    const Eigen::Vector3d& p_camera) const {
  constexpr double kMinDepthM = 0.05;
  if (p_camera.z() <= kMinDepthM) return std::nullopt;
  const Eigen::Vector2d uv = Project(camera_, p_camera);
  if (!bounds_.Contains(uv)) return std::nullopt;
  ProjectionQuery query;
  query.uv_px = uv.cast<float>();
  query.disparity_px = static_cast<float>(camera_.fx * options_.depth.baseline_m / p_camera.z());
  query.radius_px = static_cast<float>(options_.last_frame_radius_px * model_.scale(last.octave));
  query.min_octave = last.octave - 1;
  query.max_octave = last.octave + 1;
  query.angle_rad = last.angle_rad;
  return query;
}

std::optional<PoseEstimate> PoseSearch::FromKeyframe(const FrameFeatures& features,
                                                     const MapView& map, KeyframeId keyframe,
                                                     const Se3& T_world_first) const {
  const auto anchored = map.Resolve(keyframe);
  if (!anchored) return std::nullopt;
  const Keyframe& reference = *map.FindKeyframe(anchored->keyframe);
  std::vector<int> with_point;
  for (std::size_t i = 0; i < reference.points.size(); ++i) {
    if (reference.points[i].valid()) with_point.push_back(static_cast<int>(i));
  }
  std::vector<int> all(features.size());
  std::iota(all.begin(), all.end(), 0);
  const auto found = MatchByDescriptor(reference.data->features, with_point, features, all,
                                       {.max_distance = options_.reference_match_distance,
                                        .max_ratio = options_.reference_match_ratio,
                                        .check_rotation = true});
  if (static_cast<int>(found.size()) < options_.min_reference_matches) return std::nullopt;
  FrameMatches matches(features.size());
  for (const Match& match : found) {
    const MapPoint& point = *map.FindPoint(reference.points[Index(match.query)]);
    matches[Index(match.keypoint)] = MapLandmark(point, options_);
  }
  return Estimate(features, std::move(matches), T_world_first, Provisional::kIgnore);
}

std::optional<PoseEstimate> PoseSearch::FromPlace(const FrameFeatures& features, const MapView& map,
                                                  const PlaceHint& hint) const {
  const auto anchored = map.Resolve(hint.reference);
  if (!anchored) return std::nullopt;
  const Keyframe& reference = *map.FindKeyframe(anchored->keyframe);
  const Se3 T_world_camera =
      reference.T_world_camera * anchored->T_keyframe_self * hint.T_reference_camera;
  LocalMapOptions wide = options_.local_map;
  wide.radius_factor *= options_.hint_radius_factor;
  const auto expected = Expect(map, PointsOf(reference), T_world_camera, wide, HeldBack::kLeaveOut);
  FrameMatches matches = MatchExpected(features, map, expected, FrameMatches(features.size()));
  return Estimate(features, std::move(matches), T_world_camera, Provisional::kIgnore);
}

LocalMapPose PoseSearch::WithLocalMap(const FrameFeatures& features, const MapView& map,
                                      PoseEstimate first, KeyframeId last_reference) const {
  const LocalMap local =
      SelectLocalMap(map, PointIds(first.matches), last_reference, options_.local_map);
  LocalMapPose found;
  found.reference = local.reference.valid() ? local.reference : last_reference;
  found.expected =
      Expect(map, local.points, first.T_world_camera, options_.local_map, HeldBack::kInclude);
  FrameMatches matches = MatchExpected(features, map, found.expected, std::move(first.matches));
  const FrameMatches held_back = SetHeldBackAside(features, matches);
  found.num_map_matches = CountMatches(matches, Landmark::Kind::kMapPoint);
  const auto provisional = found.num_map_matches < options_.use_provisional_below
                               ? Provisional::kUse
                               : Provisional::kIgnore;
  found.estimate = Estimate(features, std::move(matches), first.T_world_camera, provisional);
  KeepAgreeing(held_back, features, camera_, options_.depth.baseline_m, model_, options_.pose,
               found.estimate);
  return found;
}

std::vector<ExpectedPoint> PoseSearch::Expect(const MapView& map, std::span<const PointId> points,
                                              const Se3& T_world_camera,
                                              const LocalMapOptions& options,
                                              HeldBack held_back) const {
  return ExpectPoints(map, points, T_world_camera, camera_, bounds_, options_.depth.baseline_m,
                      model_, options, held_back);
}

// Adds to the known matches, among the keypoints that have no map point yet.
FrameMatches PoseSearch::MatchExpected(const FrameFeatures& features, const MapView& map,
                                       std::span<const ExpectedPoint> expected,
                                       FrameMatches known) const {
  std::vector<std::uint8_t> is_taken(known.size());
  for (std::size_t i = 0; i < known.size(); ++i)
    is_taken[i] = known[i].kind == Landmark::Kind::kMapPoint ? 1 : 0;
  std::vector<ProjectionQuery> queries;
  queries.reserve(expected.size());
  for (const ExpectedPoint& point : expected)
    queries.push_back(point.query);
  const auto found = MatchByProjection(features, queries,
                                       {.max_distance = options_.local_map.match_distance,
                                        .max_ratio = options_.local_map.match_ratio},
                                       is_taken);
  for (const Match& match : found) {
    const PointId id = expected[Index(match.query)].point;
    known[Index(match.keypoint)] = MapLandmark(*map.FindPoint(id), options_);
  }
  return known;
}

// Points of objects that are not believed in have no say while the room suffices; otherwise those
// on things that rest at present do, as a minority unless there is hardly any room. Returns those
// without a say.
FrameMatches PoseSearch::SetHeldBackAside(const FrameFeatures& features,
                                          FrameMatches& matches) const {
  FrameMatches held_back = TakeHeldBack(matches);
  const int num_room = CountMatches(matches, Landmark::Kind::kMapPoint);
  if (num_room >= options_.use_held_back_below) return held_back;
  int num_left =
      num_room < options_.min_room_matches ? static_cast<int>(matches.size()) : num_room / 2;
  for (std::size_t i = 0; i < matches.size() && num_left > 0; ++i) {
    if (held_back[i].kind != Landmark::Kind::kNone &&
        features.semantics[i].label == KeypointLabel::kMovable) {
      matches[i] = std::exchange(held_back[i], Landmark{});
      --num_left;
    }
  }
  return held_back;
}

PoseEstimate PoseSearch::Estimate(const FrameFeatures& features, FrameMatches matches,
                                  const Se3& T_world_first, Provisional provisional) const {
  return EstimatePose(features, std::move(matches), T_world_first, provisional, camera_,
                      options_.depth.baseline_m, model_, options_.pose);
}

}  // namespace cslam
