// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/tracking/tracker.h"

#include "cslam/tracking/keyframe_policy.h"
#include "cslam/util/check.h"
#include "cslam/util/stopwatch.h"
#include "cslam/vision/colour_thumbnail.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace cslam {
namespace {

// Whether a camera can have moved like this in the time.
bool CanHaveMoved(const Se3& T_world_before, const Se3& T_world_after, double time_s,
                  const TrackerOptions& options) {
  const PoseDifference way = Difference(T_world_before, T_world_after);
  const double max_angle_deg = options.max_jump_deg + options.max_turn_deg_s * time_s;
  return way.distance_m <= options.max_jump_m + options.max_speed_m_s * time_s &&
         way.angle_rad <= max_angle_deg * std::numbers::pi / 180.0;
}

}  // namespace

struct Tracker::CurrentFrame {
  std::shared_ptr<KeyframeData> data;
  const RgbdFrame* frame = nullptr;
  double since_last_s = 0.0;
  std::optional<PosePrediction> prediction;  // in the map as it is now, at constant velocity
  PoseEstimate estimate;
  KeyframeId reference;                 // shares most points; chosen with the local map
  std::vector<ExpectedPoint> expected;  // of the local map
  bool is_tracked = false;
  std::optional<KeyframeProposal> proposal;
  TrackingResult result;

  const FrameFeatures& features() const { return data->features; }
};

Tracker::Tracker(const Camera& camera, const TrackerOptions& options)
    : camera_(camera),
      bounds_(UndistortedBounds(camera)),
      options_(options),
      search_(camera, options),
      observer_(camera_, options_),
      watch_(options.watch) {}

void Tracker::Reset() {
  ForgetMap();
  observer_.Clear();
}

void Tracker::Continue(const MapView& map) {
  Reset();
  searches_first_ = map.num_keyframes() > 0;
  next_keyframe_ = static_cast<std::uint32_t>(map.num_keyframe_ids());
  next_map_ = map.NextMapId().value();
}

void Tracker::ForgetMap() {
  state_ = TrackingState::kInitialising;
  searches_first_ = false;
  searches_since_.reset();
  map_ = MapId();
  history_.Clear();
  watch_.Clear();
  last_ = LastFrame{};
  velocity_.reset();
  sightings_.Take();
}

TrackerOutput Tracker::Process(const RgbdFrame& frame,
                               const std::shared_ptr<const MapSnapshot>& snapshot,
                               const Detections* detections, const PlaceHint* hint) {
  snapshot_ = snapshot ? snapshot : std::make_shared<const MapSnapshot>();
  history_.Update(snapshot_->map);
  FollowMerges();

  CurrentFrame current;
  Observe(frame, detections, current);
  if (state_ == TrackingState::kTracking || state_ == TrackingState::kRecentlyLost) {
    TrackFrame(current);
  }
  if (!current.is_tracked && hint != nullptr) Relocalise(current, *hint);
  if (!current.is_tracked && current.result.reason.empty() && hint != nullptr) {
    current.result.reason = "place not found: " + hint->reason;
  }
  if (!current.is_tracked && MayStartMap(current)) StartMap(current);
  if (current.is_tracked && !current.proposal) {
    Stopwatch watch;
    WatchObjects(current, detections);
    AddLap(current.result.times, "objects", watch);
    current.result.keyframe_reason = DecideKeyframe(current);
    if (IsProposal(current.result.keyframe_reason)) {
      current.proposal = Propose(current, current.result.keyframe_reason);
    }
  }
  if (current.is_tracked) {
    Remember(current);
    observer_.Settle(current.estimate.T_world_camera, current.result);
  } else {
    observer_.Settle(std::nullopt, current.result);
  }
  return Report(current);
}

void Tracker::Observe(const RgbdFrame& frame, const Detections* detections, CurrentFrame& current) {
  current.frame = &frame;
  current.result.frame = frame.id;
  current.result.stamp = frame.stamp;
  current.result.map_revision = snapshot_->revision;
  current.since_last_s = last_.data ? SecondsBetween(frame.stamp, last_.data->stamp) : 0.0;
  if (const auto T_world_last = history_.T_world_last(snapshot_->map)) {
    const Se3 T_last_current = velocity_ ? Exp(*velocity_ * current.since_last_s) : Se3();
    current.prediction = {*T_world_last, *T_world_last * T_last_current};
  }
  current.data = observer_.Observe(frame, current.prediction, detections, current.result);
}

void Tracker::TrackFrame(CurrentFrame& current) {
  ++frames_since_keyframe_;
  if (!current.prediction) {
    FailToTrack(current, "the map it was tracked in is gone");
    return;
  }
  Stopwatch watch;
  const bool found = FindFirstPose(current);
  AddLap(current.result.times, "predict", watch);
  if (!found) {
    FailToTrack(current, fmt::format("{} inliers < {} with the last frame",
                                     current.estimate.num_inliers(), options_.min_first_inliers));
    return;
  }
  LeaveOutUnknown(current);
  RefineWithLocalMap(current);
  AddLap(current.result.times, "local_map", watch);
  const int inliers = current.estimate.num_inliers();
  if (inliers < options_.min_inliers) {
    FailToTrack(current, fmt::format("{} inliers < {}", inliers, options_.min_inliers));
    return;
  }
  const int matches = current.result.num_map_matches;
  if (inliers < options_.sure_inliers && inliers < options_.min_inlier_share * matches) {
    FailToTrack(current, fmt::format("{} inliers of {} matches", inliers, matches));
    return;
  }
  CountSightings(current);
  current.is_tracked = true;
  state_ = TrackingState::kTracking;
  current.result.reason = fmt::format("{} inliers", inliers);
}

// From where the camera probably is, or else from the reference keyframe.
bool Tracker::FindFirstPose(CurrentFrame& current) const {
  const MapView& map = snapshot_->map;
  const PosePrediction& prediction = *current.prediction;
  if (Adopt(search_.FromMotion(current.features(), map, last_, prediction), current)) return true;
  const Se3& T_world_last = prediction.T_world_last;
  auto found = search_.FromKeyframe(current.features(), map, history_.reference(), T_world_last);
  // What looks alike, like two shelves of a kind, pulls the pose to where the other one stands.
  return Adopt(std::move(found), current) &&
         CanHaveMoved(T_world_last, current.estimate.T_world_camera, current.since_last_s,
                      options_);
}

// Whether the estimate, if there is one, will do to go on with.
bool Tracker::Adopt(std::optional<PoseEstimate> found, CurrentFrame& current) const {
  if (!found) return false;
  current.estimate = std::move(*found);
  return current.estimate.num_inliers() >= options_.min_first_inliers;
}

void Tracker::RefineWithLocalMap(CurrentFrame& current) const {
  LocalMapPose refined = search_.WithLocalMap(current.features(), snapshot_->map,
                                              std::move(current.estimate), history_.reference());
  current.estimate = std::move(refined.estimate);
  current.reference = refined.reference;
  current.expected = std::move(refined.expected);
  current.result.num_map_matches = refined.num_map_matches;
}

// Merging maps renames them: the tracker is where its reference keyframe is.
void Tracker::FollowMerges() {
  if (!history_.reference().valid()) return;
  const auto anchored = snapshot_->map.Resolve(history_.reference());
  if (anchored) EnterMap(snapshot_->map.FindKeyframe(anchored->keyframe)->map);
}

// Poses are in the world of that map from now on.
void Tracker::EnterMap(MapId map) {
  if (map == map_) return;
  map_ = map;
  observer_.StartWorld();
}

// Goes on at a place that was recognised, if the map is found there.
void Tracker::Relocalise(CurrentFrame& current, const PlaceHint& hint) {
  if (!hint.is_found || state_ == TrackingState::kTracking) return;
  if (SecondsBetween(current.data->stamp, hint.stamp) > options_.max_hint_age_s) return;
  if (!Adopt(search_.FromPlace(current.features(), snapshot_->map, hint), current)) return;
  RefineWithLocalMap(current);
  const int inliers = current.estimate.num_inliers();
  if (inliers < options_.min_relocalised_inliers) return;
  CountSightings(current);
  velocity_.reset();
  last_ = LastFrame{};  // nothing is known of the way here
  current.is_tracked = true;
  state_ = TrackingState::kTracking;
  EnterMap(snapshot_->map.FindKeyframe(current.reference)->map);
  current.result.reason = fmt::format("relocalised: {}, {} inliers", hint.reason, inliers);
}

// Keypoints on things that move though nobody named them go, with their matches.
void Tracker::LeaveOutUnknown(CurrentFrame& current) {
  const std::vector<std::uint8_t> is_dynamic = observer_.FindUnknown(
      current.estimate.T_world_camera, current.estimate.num_inliers(), *current.data);
  if (is_dynamic.empty()) return;
  FrameMatches kept;
  for (std::size_t i = 0; i < is_dynamic.size(); ++i) {
    if (is_dynamic[i] == 0) {
      kept.push_back(current.estimate.matches[i]);
    } else {
      ++current.result.num_dynamic_keypoints;
    }
  }
  current.data->features = WithoutKeypoints(current.features(), is_dynamic, bounds_);
  current.estimate.matches = std::move(kept);
}

// What the frame says about the objects of the map.
void Tracker::WatchObjects(const CurrentFrame& current, const Detections* detections) {
  if (mode_ == TrackingMode::kLocaliseOnly || !options_.objects.enabled) return;
  const std::vector<ObjectSighting> sightings = observer_.objects().Sightings();
  WatchedFrame frame;
  frame.stamp = current.data->stamp;
  frame.map = map_;
  frame.T_world_camera = current.estimate.T_world_camera;
  frame.num_inliers = current.estimate.num_inliers();
  frame.view = &observer_.objects().view();
  frame.sightings = sightings;
  if (detections != nullptr) frame.detections = detections->stamp;
  watch_.Look(frame, snapshot_->map);
}

void Tracker::CountSightings(const CurrentFrame& current) {
  if (mode_ == TrackingMode::kLocaliseOnly) return;
  sightings_.Count(current.expected, current.estimate.matches, snapshot_->map.num_point_ids());
}

void Tracker::FailToTrack(CurrentFrame& current, std::string reason) {
  current.result.num_inliers = current.estimate.num_inliers();
  const bool give_up = !current.prediction || current.since_last_s > options_.recently_lost_s;
  state_ = give_up ? TrackingState::kLost : TrackingState::kRecentlyLost;
  current.result.reason = std::move(reason);
}

KeyframeReason Tracker::DecideKeyframe(const CurrentFrame& current) const {
  if (mode_ == TrackingMode::kLocaliseOnly) return KeyframeReason::kLocaliseOnly;
  const MapView& map = snapshot_->map;
  KeyframePolicyInput input;
  input.state = state_;
  input.num_inliers = current.estimate.num_inliers();
  input.num_map_keyframes = static_cast<int>(map.num_keyframes());
  input.frames_since_keyframe = frames_since_keyframe_;
  input.proposals_in_flight = static_cast<int>(proposals_sent_ - snapshot_->proposals_applied);
  const std::size_t min_observations = map.num_keyframes() <= 2 ? 2 : 3;
  if (const Keyframe* reference = map.FindKeyframe(current.reference)) {
    for (const PointId id : reference->points) {
      const MapPoint* point = id.valid() ? map.FindPoint(id) : nullptr;
      if (point != nullptr && point->observations.size() >= min_observations) {
        ++input.reference_points;
      }
    }
  }
  for (std::size_t i = 0; i < current.features().size(); ++i) {
    if (!IsNear(current.features().keypoints[i], options_.depth)) continue;
    const bool is_map_point = current.estimate.matches[i].kind == Landmark::Kind::kMapPoint;
    ++(is_map_point ? input.near_tracked : input.near_creatable);
  }
  const KeyframeReason reason = ChooseKeyframe(input, options_.keyframe);
  const bool is_free = input.proposals_in_flight < options_.keyframe.max_in_flight &&
                       input.num_inliers >= options_.min_inliers;
  return reason == KeyframeReason::kNotNeeded && is_free && watch_.HasNews(map)
             ? KeyframeReason::kObjectChanged
             : reason;
}

bool Tracker::MayStartMap(const CurrentFrame& current) {
  if (mode_ == TrackingMode::kLocaliseOnly) return false;
  if (state_ == TrackingState::kLost) return true;
  if (state_ != TrackingState::kInitialising) return false;
  if (!searches_first_) return true;
  if (!searches_since_) searches_since_ = current.data->stamp;
  return SecondsBetween(current.data->stamp, *searches_since_) > options_.recently_lost_s;
}

void Tracker::StartMap(CurrentFrame& current) {
  const auto& keypoints = current.features().keypoints;
  const auto with_depth =
      std::count_if(keypoints.begin(), keypoints.end(), [](const auto& k) { return k.HasDepth(); });
  if (with_depth < options_.min_initial_points) {
    if (current.result.reason.empty()) {
      current.result.reason =
          fmt::format("{} keypoints with depth < {}", with_depth, options_.min_initial_points);
    }
    return;
  }
  ForgetMap();
  observer_.StartWorld();
  map_ = MapId(next_map_++);
  state_ = TrackingState::kTracking;
  current.is_tracked = true;
  current.reference = KeyframeId();
  current.estimate = PoseEstimate{};
  current.estimate.matches.resize(keypoints.size());
  current.result.reason = fmt::format("map {} starts with {} points", map_.value(), with_depth);
  current.result.keyframe_reason = KeyframeReason::kStartsMap;
  current.proposal = Propose(current, KeyframeReason::kStartsMap);
}

KeyframeObjects Tracker::TakeObjects(const CurrentFrame& current) {
  if (!options_.objects.enabled || !options_.watch.enabled) return {};
  KeyframeObjects objects;
  objects.view = observer_.objects().view();
  objects.sightings = observer_.objects().Sightings();
  for (ObjectSighting& sighting : objects.sightings)
    sighting.colours = ColoursOf(current.frame->bgr, sighting.region);
  objects.evidence = watch_.Take();
  return objects;
}

KeyframeProposal Tracker::Propose(CurrentFrame& current, KeyframeReason reason) {
  current.data->depth_small_mm = observer_.RestingDepth(current.frame->depth_m);
  current.data->bgr_small = MakeColourThumbnail(current.frame->bgr);
  KeyframeProposal proposal;
  proposal.id = KeyframeId(next_keyframe_++);
  proposal.map = map_;
  proposal.reason = reason;
  proposal.data = current.data;
  proposal.reference = current.reference;
  const Se3 T_world_reference =
      current.reference.valid()
          ? history_.T_world_keyframe(snapshot_->map, current.reference).value()
          : Se3();
  proposal.T_reference_camera = T_world_reference.Inverse() * current.estimate.T_world_camera;
  proposal.matches = PointIds(current.estimate.matches);
  proposal.sightings = sightings_.Take();
  proposal.objects = TakeObjects(current);
  history_.AddPending(proposal.id, proposal.reference, proposal.T_reference_camera);
  ++proposals_sent_;
  frames_since_keyframe_ = 0;
  current.reference = proposal.id;
  return proposal;
}

// Makes the current frame the last one.
void Tracker::Remember(const CurrentFrame& current) {
  const Se3& T_world_camera = current.estimate.T_world_camera;
  const bool continues = last_.data != nullptr && current.prediction && current.since_last_s > 0.0;
  if (continues) {
    velocity_ =
        Log(current.prediction->T_world_last.Inverse() * T_world_camera) / current.since_last_s;
  } else {
    velocity_.reset();
  }
  const Se3 T_world_reference =
      history_.T_world_keyframe(snapshot_->map, current.reference).value();
  history_.SetLast(current.reference, T_world_reference.Inverse() * T_world_camera);
  last_ = {current.data, PointIds(current.estimate.matches)};
}

TrackerOutput Tracker::Report(CurrentFrame& current) {
  TrackingResult& result = current.result;
  result.state = state_;
  result.map = map_;
  if (current.is_tracked) {
    result.T_world_camera = current.estimate.T_world_camera;
    result.reference = history_.reference();
    result.T_reference_camera = history_.T_reference_last();
    result.num_inliers = current.estimate.num_inliers();
  }
  std::optional<LostFrame> lost;
  if (!current.is_tracked && snapshot_->map.num_keyframes() > 0) {
    current.data->depth_small_mm = observer_.RestingDepth(current.frame->depth_m);
    lost = LostFrame{current.data};
  }
  return {std::move(result), std::move(current.proposal), std::move(lost)};
}

}  // namespace cslam
