// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/relocaliser.h"

#include "cslam/util/options.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace cslam {
namespace {

constexpr int kMinSharedPoints = 15;
constexpr std::size_t kMaxNeighbours = 10;

// The keyframe that sees most of the points; the smallest id of equals.
KeyframeId FindReference(const MapView& map, const std::vector<PointId>& points,
                         KeyframeId fallback) {
  std::vector<std::int32_t> votes(map.num_keyframe_ids(), 0);
  for (const PointId id : points) {
    if (!id.valid()) continue;
    for (const PointObservation& o : map.FindPoint(id)->observations)
      ++votes[o.keyframe.index()];
  }
  const auto most = std::max_element(votes.begin(), votes.end());
  if (most == votes.end() || *most == 0) return fallback;
  return KeyframeId(static_cast<std::uint32_t>(most - votes.begin()));
}

RelocatedFrame Relocate(const MapView& map, const PlaceVerification& verification) {
  RelocatedFrame frame;
  frame.map = map.FindKeyframe(verification.candidate)->map;
  frame.T_world_camera = verification.T_world_camera;
  frame.points = verification.points;
  frame.reference = FindReference(map, frame.points, verification.candidate);
  frame.T_reference_camera =
      map.FindKeyframe(frame.reference)->T_world_camera.Inverse() * frame.T_world_camera;
  return frame;
}

// An accepted attempt that puts the frame elsewhere in the same map, with nearly as many inliers.
const PlaceVerification* FindRival(const MapView& map, const PlaceVerification& best,
                                   const std::vector<PlaceVerification>& attempts,
                                   const RelocaliserOptions& options) {
  const MapId best_map = map.FindKeyframe(best.candidate)->map;
  for (const PlaceVerification& other : attempts) {
    if (!other.IsAccepted() || map.FindKeyframe(other.candidate)->map != best_map) continue;
    if (other.num_inliers < options.rival_ratio * best.num_inliers) continue;
    const PoseDifference d = Difference(best.T_world_camera, other.T_world_camera);
    if (d.distance_m > options.rival_distance_m ||
        d.angle_rad > options.rival_angle_deg * std::numbers::pi / 180.0) {
      return &other;
    }
  }
  return nullptr;
}

// Whether another view of the same place was accepted: this one would say the same again.
bool IsFoundAlready(const MapView& map, KeyframeId id,
                    const std::vector<PlaceVerification>& attempts) {
  const auto& covisible = map.FindKeyframe(id)->covisible;
  return std::any_of(attempts.begin(), attempts.end(), [&](const PlaceVerification& attempt) {
    return attempt.IsAccepted() &&
           std::any_of(covisible.begin(), covisible.end(), [&](const CovisibleKeyframe& n) {
             return n.id == attempt.candidate && n.shared_points >= kMinSharedPoints;
           });
  });
}

}  // namespace

void Describe(OptionList& list, RelocaliserOptions& o) {
  list.Add("max_results", o.max_results, {1, 1000}, "keyframes",
           "Keyframes that look like the frame and are ranked by place.");
  list.Add("max_candidates", o.max_candidates, {1, 100}, "keyframes",
           "Keyframes verified at most for one frame.");
  list.Add("min_votes", o.min_votes, {1, 1000}, "features",
           "Keyframes in which fewer features were recognised are not verified.");
  list.Add("sure_inliers", o.sure_inliers, {10, 10'000}, "points",
           "With so many inliers no further candidate is looked at.");
  list.Add("rival_ratio", o.rival_ratio, {0.0, 1.0}, "",
           "Two places with inliers nearer to equal than this are told apart by no one: the frame "
           "counts as not found.");
  list.Add("rival_distance", o.rival_distance_m, {0.01, 100.0}, "m",
           "Poses further apart than this are two places.");
  list.Add("rival_angle", o.rival_angle_deg, {0.1, 180.0}, "deg",
           "Poses turned against each other by more than this are two places.");
  list.Group("verification", o.verification);
}

std::vector<PlaceCandidate> RankPlaces(const MapView& map,
                                       const std::vector<PlaceCandidate>& candidates) {
  std::vector<double> score_of(map.num_keyframe_ids(), 0.0);
  for (const PlaceCandidate& candidate : candidates)
    score_of[candidate.keyframe.index()] = candidate.score;
  std::vector<std::pair<double, PlaceCandidate>> ranked;  // by the score of its surroundings
  for (const PlaceCandidate& candidate : candidates) {
    double score = candidate.score;
    for (const auto& n : map.Neighbours(candidate.keyframe, kMinSharedPoints, kMaxNeighbours))
      score += score_of[n.id.index()];
    ranked.emplace_back(score, candidate);
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });

  std::vector<PlaceCandidate> first, later;
  std::vector<std::uint8_t> is_covered(map.num_keyframe_ids(), 0);
  for (const auto& [score, candidate] : ranked) {
    const KeyframeId id = candidate.keyframe;
    (is_covered[id.index()] == 0 ? first : later).push_back(candidate);
    is_covered[id.index()] = 1;
    for (const auto& n : map.Neighbours(id, kMinSharedPoints, kMaxNeighbours))
      is_covered[n.id.index()] = 1;
  }
  first.insert(first.end(), later.begin(), later.end());
  return first;
}

Relocaliser::Relocaliser(PlaceSensor sensor, const RelocaliserOptions& options)
    : sensor_(std::move(sensor)), options_(options) {}

RelocalisationResult Relocaliser::Find(const FrameFeatures& features, const MapView& map,
                                       const PlaceIndex& index, const MapFilter& may_search) const {
  const auto is_excluded = [&](KeyframeId id) {
    const Keyframe* keyframe = map.FindKeyframe(id);
    return keyframe == nullptr || (may_search && !may_search(keyframe->map));
  };
  const std::vector<int> keypoints = PlaceKeypoints(features);
  std::vector<PlaceCandidate> places =
      index.Query(SelectDescriptors(features, keypoints), is_excluded,
                  static_cast<std::size_t>(options_.max_results));
  std::erase_if(places, [&](const auto& place) { return place.votes < options_.min_votes; });
  places = RankPlaces(map, places);
  places.resize(std::min(places.size(), static_cast<std::size_t>(options_.max_candidates)));

  RelocalisationResult result;
  std::size_t best = 0;
  for (const PlaceCandidate& place : places) {
    if (IsFoundAlready(map, place.keyframe, result.attempts)) continue;
    result.candidates.push_back(place);
    result.attempts.push_back(
        VerifyPlace(features, map, place.keyframe, sensor_, options_.verification));
    const PlaceVerification& attempt = result.attempts.back();
    const PlaceVerification& leader = result.attempts[best];
    const bool leads = attempt.IsAccepted() != leader.IsAccepted()
                           ? attempt.IsAccepted()
                           : attempt.num_inliers > leader.num_inliers;
    if (leads) best = result.attempts.size() - 1;
    if (attempt.IsAccepted() && attempt.num_inliers >= options_.sure_inliers) break;
  }
  if (result.attempts.empty()) {
    result.reason = "nothing in the map looks like it";
    return result;
  }
  const PlaceVerification& winner = result.attempts[best];
  result.reason = fmt::format("keyframe {}: {}", winner.candidate.value(), winner.reason);
  if (!winner.IsAccepted()) return result;
  if (const auto* rival = FindRival(map, winner, result.attempts, options_)) {
    result.reason +=
        fmt::format(", but keyframe {} elsewhere: {}", rival->candidate.value(), rival->reason);
    return result;
  }
  result.found = Relocate(map, winner);
  return result;
}

}  // namespace cslam
