// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/relocaliser.h"

#include "cslam/loop/loop_sides.h"
#include "cslam/util/options.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace cslam {
namespace {

constexpr int kMinSharedPoints = 15;  // with fewer, keyframes hardly see the same

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
  list.Group("candidates", o.candidates);
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
  list.Group("depth_check", o.depth_check);
}

Relocaliser::Relocaliser(PlaceSensor sensor, const RelocaliserOptions& options)
    : sensor_(std::move(sensor)), options_(options) {}

// By looks, and by what depth the keyframes there measured.
PlaceVerification Relocaliser::Verify(const FrameFeatures& features, const MapView& map,
                                      KeyframeId candidate, const cv::Mat& depth_small_mm) const {
  PlaceVerification seen = VerifyPlace(features, map, candidate, sensor_, options_.verification);
  if (!seen.IsAccepted() || depth_small_mm.empty()) return seen;
  const DepthComparison depth = CompareWithPlace(
      map, candidate, {depth_small_mm, seen.T_world_camera}, sensor_.camera, options_.depth_check);
  const std::string objection = WhyContradicted(depth, options_.depth_check);
  if (objection.empty()) return seen;
  seen.outcome = VerificationOutcome::kContradicted;
  seen.reason += ", but " + objection;
  return seen;
}

RelocalisationResult Relocaliser::Find(const FrameFeatures& features, const MapView& map,
                                       const PlaceIndex& index, const MapFilter& may_search,
                                       const cv::Mat& depth_small_mm) const {
  const auto is_excluded = [&](KeyframeId id) {
    const Keyframe* keyframe = map.FindKeyframe(id);
    return keyframe == nullptr || (may_search && !may_search(keyframe->map));
  };
  const auto places = FindPlaces(map, index, SelectDescriptors(features, PlaceKeypoints(features)),
                                 is_excluded, options_.candidates);

  RelocalisationResult result;
  std::size_t best = 0;
  for (const PlaceCandidate& place : places) {
    if (IsFoundAlready(map, place.keyframe, result.attempts)) continue;
    result.candidates.push_back(place);
    result.attempts.push_back(Verify(features, map, place.keyframe, depth_small_mm));
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
