// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/loop_closer.h"

#include "cslam/loop/depth_check.h"
#include "cslam/loop/essential_graph.h"
#include "cslam/loop/loop_fusion.h"
#include "cslam/loop/loop_sides.h"
#include "cslam/loop/overlap_check.h"
#include "cslam/loop/place_candidates.h"
#include "cslam/util/check.h"

#include <fmt/core.h>

#include <algorithm>
#include <numbers>
#include <utility>

namespace cslam {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

LoopRecord StartRecord(const Keyframe& query, const Keyframe& match, double score) {
  LoopRecord record;
  record.query = query.id;
  record.match = match.id;
  record.query_stamp = query.data->stamp;
  record.match_stamp = match.data->stamp;
  record.query_map = query.map;
  record.match_map = match.map;
  record.evidence.score = score;
  return record;
}

// Why a loop within one map moves its newer end too far; empty if it does not.
std::string WhyTooFar(const LoopEvidence& evidence, const LoopOptions& options) {
  const double max_drift_m = options.max_drift_m + options.max_drift_share * evidence.path_m;
  if (evidence.drift_m > max_drift_m) {
    return fmt::format("would move by {:.2f} m after a way of {:.1f} m, more than drift explains",
                       evidence.drift_m, evidence.path_m);
  }
  const double max_drift_deg =
      options.max_drift_deg + options.max_drift_deg_per_m * evidence.path_m;
  if (evidence.drift_rad > max_drift_deg * kDegree) {
    return fmt::format("would turn by {:.0f} deg after a way of {:.1f} m, more than drift explains",
                       evidence.drift_rad / kDegree, evidence.path_m);
  }
  return {};
}

// Why no camera can have gone from one map to the other, were they merged so; empty if one can.
// T_match_query: between the two worlds.
std::string WhyTooFast(const MapView& map, const Keyframe& query, const Keyframe& match,
                       const Se3& T_match_query, const LoopOptions& options) {
  const auto transition = TransitionBetween(map, match.map, query.map);
  if (!transition) return {};
  const Se3 T_match_last = map.FindKeyframe(transition->a)->T_world_camera;
  const Se3 T_match_first = T_match_query * map.FindKeyframe(transition->b)->T_world_camera;
  const double way_m = Difference(T_match_last, T_match_first).distance_m;
  if (way_m <= options.max_drift_m + options.max_speed_m_s * transition->time_s) return {};
  return fmt::format("would take the camera {:.1f} m in {:.1f} s from one map to the other", way_m,
                     transition->time_s);
}

bool IsSeenFromNear(const MapPoint& point, const std::vector<std::uint8_t>& is_near) {
  return std::any_of(point.observations.begin(), point.observations.end(),
                     [&](const PointObservation& o) { return is_near[o.keyframe.index()] != 0; });
}

MapId MapOf(const MapView& map, KeyframeId id) {
  const auto anchor = map.Resolve(id);
  return anchor ? map.FindKeyframe(anchor->keyframe)->map : MapId();
}

LoopEdge EdgeOf(const LoopRecord& record) {
  return {record.match, record.query, *record.T_match_query};
}

LoopEdge Reversed(const LoopEdge& loop) {
  return {loop.query, loop.match, loop.T_match_query.Inverse()};
}

}  // namespace

LoopCloser::LoopCloser(PlaceSensor sensor, const LoopOptions& options)
    : sensor_(std::move(sensor)), options_(options) {}

void LoopCloser::Reset() {
  pending_.reset();
}

LoopOutcome LoopCloser::Process(KeyframeId keyframe, const MapView& map, const PlaceIndex& index) {
  LoopOutcome outcome;
  const Keyframe* query = map.FindKeyframe(keyframe);
  if (query == nullptr) return outcome;
  const auto is_near =
      Neighbourhood(map, *query, options_.min_shared_points, options_.min_keyframes_apart);
  const auto is_excluded = [&](KeyframeId id) {
    return map.FindKeyframe(id) == nullptr || is_near[id.index()] != 0;
  };
  const auto descriptors = SelectDescriptors(query->data->features, PlaceKeypoints(map, *query));
  const auto candidates = FindPlaces(map, index, descriptors, is_excluded, options_.candidates);
  const PointFilter may_use = [&](const MapPoint& p) {
    return !IsSeenFromNear(p, is_near) && (options_.use_objects || !p.object.valid());
  };
  for (const PlaceCandidate& candidate : candidates)
    outcome.records.push_back(Examine(*query, candidate, map, may_use));

  LoopRecord* best = nullptr;
  for (LoopRecord& record : outcome.records) {
    if (!record.reason.empty()) continue;
    record.reason = "another keyframe of the place was found better";
    if (best == nullptr || record.evidence.num_inliers > best->evidence.num_inliers) best = &record;
  }
  if (best == nullptr) {
    MissOne();
    return outcome;
  }
  Consider(*best, map, may_use);
  if (best->verdict == LoopVerdict::kPending) return outcome;
  outcome.correction = Close(*best, map);
  pending_.reset();
  return outcome;
}

// An empty reason: verified.
LoopRecord LoopCloser::Examine(const Keyframe& query, const PlaceCandidate& candidate,
                               const MapView& map, const PointFilter& may_use) const {
  const Keyframe& match = *map.FindKeyframe(candidate.keyframe);
  LoopRecord record = StartRecord(query, match, candidate.score);
  const PlaceVerification seen = VerifyPlace(query.data->features, map, candidate.keyframe, sensor_,
                                             options_.verification, may_use);
  record.evidence.num_matches = seen.num_matches;
  record.evidence.num_ransac_inliers = seen.num_ransac_inliers;
  record.evidence.num_inliers = seen.num_inliers;
  record.evidence.num_expected = seen.num_expected;
  record.evidence.inlier_spread = seen.spread();
  record.evidence.median_error_px = seen.median_error_px;
  if (!seen.IsAccepted()) {
    record.reason = seen.reason;
    return record;
  }
  record.T_match_query = match.T_world_camera.Inverse() * seen.T_world_camera;
  record.evidence.num_confirmations = 1;
  const DepthComparison depth =
      CompareWithPlace(map, candidate.keyframe, {query.data->depth_small_mm, seen.T_world_camera},
                       sensor_.camera, options_.depth_check);
  record.evidence.depth_compared = depth.num_compared();
  record.evidence.depth_contradicted = depth.contradicted();
  if (match.map == query.map) {
    const PoseDifference drift = Difference(query.T_world_camera, seen.T_world_camera);
    record.evidence.path_m = PathLength(map, query, match);
    record.evidence.drift_m = drift.distance_m;
    record.evidence.drift_rad = drift.angle_rad;
    record.reason = WhyTooFar(record.evidence, options_);
  } else {
    record.reason = WhyTooFast(map, query, match,
                               seen.T_world_camera * query.T_world_camera.Inverse(), options_);
  }
  return record;
}

bool LoopCloser::Agree(const LoopEdge& a, const LoopEdge& b, const MapView& map) const {
  if (MapOf(map, a.match) != MapOf(map, b.match) || MapOf(map, a.query) != MapOf(map, b.query)) {
    return false;
  }
  const auto T_world_match_a = map.T_world_keyframe(a.match);
  const auto T_world_match_b = map.T_world_keyframe(b.match);
  const auto T_world_query_a = map.T_world_keyframe(a.query);
  const auto T_world_query_b = map.T_world_keyframe(b.query);
  if (!T_world_match_a || !T_world_match_b || !T_world_query_a || !T_world_query_b) return false;
  const Se3 T_query_a_b = T_world_query_a->Inverse() * *T_world_query_b;
  const PoseDifference difference = Difference(*T_world_match_a * a.T_match_query * T_query_a_b,
                                               *T_world_match_b * b.T_match_query);
  return difference.distance_m <= options_.agreement_m &&
         difference.angle_rad <= options_.agreement_deg * kDegree;
}

// How many neighbours of the query find the same place and agree where it is; stops at max_count.
int LoopCloser::CountConfirmingNeighbours(const LoopEdge& loop, const MapView& map,
                                          const PointFilter& may_use, int max_count) const {
  int count = 0;
  const auto neighbours = map.Neighbours(loop.query, options_.min_shared_points,
                                         static_cast<std::size_t>(options_.confirming_neighbours));
  for (const CovisibleKeyframe& neighbour : neighbours) {
    if (count >= max_count) break;
    const Keyframe& query = *map.FindKeyframe(neighbour.id);
    const PlaceVerification seen =
        VerifyPlace(query.data->features, map, loop.match, sensor_, options_.verification, may_use);
    if (!seen.IsAccepted()) continue;
    const Se3 T_world_match = map.FindKeyframe(loop.match)->T_world_camera;
    const LoopEdge found{loop.match, neighbour.id, T_world_match.Inverse() * seen.T_world_camera};
    if (Agree(loop, found, map)) ++count;
  }
  return count;
}

// Decides whether enough keyframes have found the place.
void LoopCloser::Consider(LoopRecord& record, const MapView& map, const PointFilter& may_use) {
  const LoopEdge loop = EdgeOf(record);
  const bool is_known = pending_ && Agree(pending_->loop, loop, map);
  pending_ = Hypothesis{.loop = loop, .sightings = is_known ? pending_->sightings + 1 : 1};
  const int needed =
      record.query_map == record.match_map ? options_.confirmations : options_.merge_confirmations;
  int confirmations = pending_->sightings;
  if (confirmations < needed) {
    // Neighbours may be those that were counted as earlier sightings, so the two do not add up.
    confirmations =
        std::max(confirmations, 1 + CountConfirmingNeighbours(loop, map, may_use, needed - 1));
  }
  record.evidence.num_confirmations = confirmations;
  if (confirmations >= needed) return;
  record.verdict = LoopVerdict::kPending;
  record.reason = fmt::format("found by {} of {} keyframes", confirmations, needed);
}

void LoopCloser::MissOne() {
  if (pending_ && ++pending_->missed > options_.max_missed) pending_.reset();
}

// Corrects the map unless measured depth says no; the record tells which.
std::optional<MapCorrection> LoopCloser::Close(LoopRecord& record, const MapView& map) {
  MapCorrection correction = Solve(record, map);
  const CorrectedView view(map, correction.moves);
  const DepthComparison depth = CompareSides(correction.loop, view);
  record.evidence.depth_compared = depth.num_compared();
  record.evidence.depth_contradicted = depth.contradicted();
  record.reason = WhyContradicted(depth, options_.depth_check);
  if (record.reason.empty() && correction.merge_into.valid()) {
    const OverlapComparison overlap = CompareOverlap(view, correction.map, correction.merge_into,
                                                     sensor_, options_.fusion, options_.overlap);
    record.reason = WhyContradicted(overlap, options_.overlap);
  }
  if (!record.reason.empty()) return std::nullopt;

  const LoopSides sides = SidesOf(map, correction.loop.match, correction.loop.query,
                                  options_.fusion.keyframes_per_side);
  LoopFusions fusions =
      FindFusions(view, sides.moving, UsablePoints(map, sides.fixed), sensor_, options_.fusion);
  correction.pairs = std::move(fusions.pairs);
  correction.found = std::move(fusions.found);
  record.verdict = correction.merge_into.valid() ? LoopVerdict::kMerged : LoopVerdict::kClosed;
  record.reason = fmt::format("{} inliers, found by {} keyframes", record.evidence.num_inliers,
                              record.evidence.num_confirmations);
  return correction;
}

DepthComparison LoopCloser::CompareSides(const LoopEdge& loop, const CorrectedView& view) const {
  const DepthCheckOptions& options = options_.depth_check;
  const LoopSides sides = SidesOf(view.map(), loop.match, loop.query, options.keyframes_per_side);
  return CompareDepth(PlacedDepths(view, sides.fixed), PlacedDepths(view, sides.moving),
                      sensor_.camera, options);
}

// What the loop asks of the map, points aside.
MapCorrection LoopCloser::Solve(const LoopRecord& record, const MapView& map) const {
  const bool is_merge = record.query_map != record.match_map;
  // The younger map goes into the older one, so that the first keyframe of all keeps its place.
  const bool is_reversed = is_merge && record.query_map < record.match_map;
  MapCorrection correction;
  correction.epoch = map.correction_epoch();
  correction.loop = is_reversed ? Reversed(EdgeOf(record)) : EdgeOf(record);
  correction.map = is_reversed ? record.match_map : record.query_map;
  const LoopEdge& loop = correction.loop;
  if (is_merge) {
    correction.merge_into = is_reversed ? record.query_map : record.match_map;
    correction.moves =
        MoveRigidly(map, correction.map,
                    map.FindKeyframe(loop.match)->T_world_camera * loop.T_match_query *
                        map.FindKeyframe(loop.query)->T_world_camera.Inverse());
  } else if (record.evidence.drift_m >= options_.min_drift_m ||
             record.evidence.drift_rad >= options_.min_drift_deg * kDegree) {
    correction.moves = SpreadLoop(map, loop, map.loops(), options_.graph);
  }
  return correction;
}

}  // namespace cslam
