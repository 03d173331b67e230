// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/tracking/tracker.h"

#include "cslam/tracking/keyframe_policy.h"
#include "cslam/util/check.h"
#include "cslam/util/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
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

// Whether a camera can have moved like this in the time.
bool CanHaveMoved(const Se3& T_world_before, const Se3& T_world_after, double time_s,
                  const TrackerOptions& options) {
  const PoseDifference way = Difference(T_world_before, T_world_after);
  const double max_angle_deg = options.max_jump_deg + options.max_turn_deg_s * time_s;
  return way.distance_m <= options.max_jump_m + options.max_speed_m_s * time_s &&
         way.angle_rad <= max_angle_deg * std::numbers::pi / 180.0;
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

bool IsNear(const Keypoint& keypoint, const DepthOptions& options) {
  return keypoint.HasDepth() && static_cast<double>(keypoint.depth_m) < options.near_depth_m();
}

}  // namespace

struct Tracker::CurrentFrame {
  std::shared_ptr<KeyframeData> data;
  const RgbdFrame* frame = nullptr;
  double since_last_s = 0.0;
  std::optional<Se3> T_world_last;  // in the map as it is now
  Se3 T_world_predicted;            // at constant velocity
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
      model_(LevelScales(options.orb), options.depth.disparity_sigma_px),
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
  last_data_.reset();
  last_points_.clear();
  velocity_.reset();
  TakeSightings();
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
  current.since_last_s = last_data_ ? SecondsBetween(frame.stamp, last_tracked_) : 0.0;
  current.T_world_last = history_.T_world_last(snapshot_->map);
  std::optional<PosePrediction> prediction;
  if (current.T_world_last) {
    const Se3 T_last_current = velocity_ ? Exp(*velocity_ * current.since_last_s) : Se3();
    current.T_world_predicted = *current.T_world_last * T_last_current;
    prediction = {*current.T_world_last, current.T_world_predicted};
  }
  current.data = observer_.Observe(frame, prediction, detections, current.result);
}

void Tracker::TrackFrame(CurrentFrame& current) {
  ++frames_since_keyframe_;
  if (!current.T_world_last) {
    FailToTrack(current, "the map it was tracked in is gone");
    return;
  }
  Stopwatch watch;
  const bool found = EstimateFromMotion(current) || EstimateFromReference(current);
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

// Projects what the last frame saw with a constant-velocity prediction.
bool Tracker::EstimateFromMotion(CurrentFrame& current) {
  const Se3 T_predicted_world = current.T_world_predicted.Inverse();

  const FrameFeatures& last = last_data_->features;
  std::vector<Landmark> landmarks;
  std::vector<ProjectionQuery> queries;
  const bool use_held_back =
      CountUsable(snapshot_->map, last_points_) < options_.use_held_back_below;
  for (std::size_t i = 0; i < last.size(); ++i) {
    Landmark landmark;
    const auto id =
        last_points_[i].valid() ? snapshot_->map.Resolve(last_points_[i]) : std::nullopt;
    if (id) {
      const MapPoint& point = *snapshot_->map.FindPoint(*id);
      if (!IsUsable(point) && !use_held_back) continue;
      landmark = MapLandmark(point, options_);
    } else if (IsNear(last.keypoints[i], options_.depth)) {
      const Eigen::Vector3d p_last = Unproject(camera_, last.keypoints[i].uv_px.cast<double>(),
                                               static_cast<double>(last.keypoints[i].depth_m));
      landmark = {Landmark::Kind::kProvisional, PointId(), false, *current.T_world_last * p_last,
                  TrustIn(0, options_)};
    } else {
      continue;
    }
    const Eigen::Vector3d p_camera = T_predicted_world * landmark.p_world;
    if (p_camera.z() <= 0.05) continue;
    const Eigen::Vector2d uv = Project(camera_, p_camera);
    if (!bounds_.Contains(uv)) continue;
    const int octave = last.keypoints[i].octave;
    ProjectionQuery query;
    query.uv_px = uv.cast<float>();
    query.disparity_px = static_cast<float>(camera_.fx * options_.depth.baseline_m / p_camera.z());
    query.radius_px = static_cast<float>(options_.last_frame_radius_px * model_.scale(octave));
    query.min_octave = octave - 1;
    query.max_octave = octave + 1;
    query.descriptor = last.descriptors[i];
    query.angle_rad = last.keypoints[i].angle_rad;
    landmarks.push_back(landmark);
    queries.push_back(query);
  }

  const MatchOptions match_options{
      .max_distance = options_.local_map.match_distance, .max_ratio = 0.9, .check_rotation = true};
  auto found = MatchByProjection(current.features(), queries, match_options);
  if (static_cast<int>(found.size()) < options_.min_last_frame_matches) {
    for (ProjectionQuery& query : queries)
      query.radius_px *= 2.0F;
    found = MatchByProjection(current.features(), queries, match_options);
  }
  if (static_cast<int>(found.size()) < options_.min_last_frame_matches) return false;
  FrameMatches matches(current.features().size());
  for (const Match& match : found)
    matches[Index(match.keypoint)] = landmarks[Index(match.query)];
  current.estimate =
      EstimatePose(current.features(), std::move(matches), current.T_world_predicted,
                   Provisional::kUse, camera_, options_.depth.baseline_m, model_, options_.pose);
  return current.estimate.num_inliers() >= options_.min_first_inliers;
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
  if (!EstimateFromPlace(current, hint)) return;
  RefineWithLocalMap(current);
  const int inliers = current.estimate.num_inliers();
  if (inliers < options_.min_relocalised_inliers) return;
  CountSightings(current);
  velocity_.reset();
  last_data_.reset();  // nothing is known of the way here
  current.is_tracked = true;
  state_ = TrackingState::kTracking;
  EnterMap(snapshot_->map.FindKeyframe(current.reference)->map);
  current.result.reason = fmt::format("relocalised: {}, {} inliers", hint.reason, inliers);
}

// Projects what the keyframes around a recognised place see.
bool Tracker::EstimateFromPlace(CurrentFrame& current, const PlaceHint& hint) {
  const MapView& map = snapshot_->map;
  const auto anchored = map.Resolve(hint.reference);
  if (!anchored) return false;
  const Keyframe& reference = *map.FindKeyframe(anchored->keyframe);
  const Se3 T_world_camera =
      reference.T_world_camera * anchored->T_keyframe_self * hint.T_reference_camera;
  LocalMapOptions wide = options_.local_map;
  wide.radius_factor *= options_.hint_radius_factor;
  const auto points = PointsOf(reference);
  const auto expected = ExpectPoints(map, points, T_world_camera, camera_, bounds_,
                                     options_.depth.baseline_m, model_, wide);
  std::vector<ProjectionQuery> queries;
  for (const ExpectedPoint& point : expected)
    queries.push_back(point.query);
  const auto found = MatchByProjection(
      current.features(), queries,
      {.max_distance = options_.local_map.match_distance, .max_ratio = wide.match_ratio});
  FrameMatches matches(current.features().size());
  for (const Match& match : found) {
    const PointId id = expected[Index(match.query)].point;
    matches[Index(match.keypoint)] = MapLandmark(*map.FindPoint(id), options_);
  }
  current.estimate =
      EstimatePose(current.features(), std::move(matches), T_world_camera, Provisional::kIgnore,
                   camera_, options_.depth.baseline_m, model_, options_.pose);
  current.reference = anchored->keyframe;
  return current.estimate.num_inliers() >= options_.min_first_inliers;
}

// Without a prediction: matches descriptors with the reference keyframe.
bool Tracker::EstimateFromReference(CurrentFrame& current) {
  const auto anchored = snapshot_->map.Resolve(history_.reference());
  if (!anchored) return false;
  const Keyframe& reference = *snapshot_->map.FindKeyframe(anchored->keyframe);
  std::vector<int> with_point;
  for (std::size_t i = 0; i < reference.points.size(); ++i) {
    if (reference.points[i].valid()) with_point.push_back(static_cast<int>(i));
  }
  std::vector<int> all(current.features().size());
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = static_cast<int>(i);
  const auto found =
      MatchByDescriptor(reference.data->features, with_point, current.features(), all,
                        {.max_distance = options_.reference_match_distance,
                         .max_ratio = options_.reference_match_ratio,
                         .check_rotation = true});
  if (static_cast<int>(found.size()) < options_.min_reference_matches) return false;
  FrameMatches matches(current.features().size());
  for (const Match& match : found) {
    const MapPoint& point = *snapshot_->map.FindPoint(reference.points[Index(match.query)]);
    matches[Index(match.keypoint)] = MapLandmark(point, options_);
  }
  current.estimate =
      EstimatePose(current.features(), std::move(matches), *current.T_world_last,
                   Provisional::kIgnore, camera_, options_.depth.baseline_m, model_, options_.pose);
  // What looks alike, like two shelves of a kind, pulls the pose to where the other one stands.
  return current.estimate.num_inliers() >= options_.min_first_inliers &&
         CanHaveMoved(*current.T_world_last, current.estimate.T_world_camera, current.since_last_s,
                      options_);
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

void Tracker::RefineWithLocalMap(CurrentFrame& current) {
  const MapView& map = snapshot_->map;
  FrameMatches matches = std::move(current.estimate.matches);
  const LocalMap local =
      SelectLocalMap(map, PointIds(matches), history_.reference(), options_.local_map);
  current.reference = local.reference.valid() ? local.reference : history_.reference();
  current.expected =
      ExpectPoints(map, local.points, current.estimate.T_world_camera, camera_, bounds_,
                   options_.depth.baseline_m, model_, options_.local_map, HeldBack::kInclude);

  std::vector<std::uint8_t> is_taken(matches.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    is_taken[i] = matches[i].kind == Landmark::Kind::kMapPoint ? 1 : 0;
  }
  std::vector<ProjectionQuery> queries;
  queries.reserve(current.expected.size());
  for (const ExpectedPoint& expected : current.expected)
    queries.push_back(expected.query);
  const auto found = MatchByProjection(current.features(), queries,
                                       {.max_distance = options_.local_map.match_distance,
                                        .max_ratio = options_.local_map.match_ratio},
                                       is_taken);
  for (const Match& match : found) {
    const PointId id = current.expected[Index(match.query)].point;
    matches[Index(match.keypoint)] = MapLandmark(*map.FindPoint(id), options_);
  }
  const FrameMatches held_back = SetHeldBackAside(current.features(), matches);

  const int num_map_matches = CountMatches(matches, Landmark::Kind::kMapPoint);
  current.result.num_map_matches = num_map_matches;
  const auto provisional =
      num_map_matches < options_.use_provisional_below ? Provisional::kUse : Provisional::kIgnore;
  current.estimate =
      EstimatePose(current.features(), std::move(matches), current.estimate.T_world_camera,
                   provisional, camera_, options_.depth.baseline_m, model_, options_.pose);
  KeepAgreeing(held_back, current.features(), camera_, options_.depth.baseline_m, model_,
               options_.pose, current.estimate);
}

// Points of objects that are not believed in have no say while the room suffices; otherwise those
// on things that rest at present do, as a minority unless there is hardly any room. Returns those
// without a say.
FrameMatches Tracker::SetHeldBackAside(const FrameFeatures& features, FrameMatches& matches) const {
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
  sightings_.resize(std::max(sightings_.size(), snapshot_->map.num_point_ids()));
  const auto entry = [&](PointId id) -> PointSightings& {
    PointSightings& sightings = sightings_[id.index()];
    if (!sightings.point.valid()) {
      sightings.point = id;
      sighted_.push_back(id);
    }
    return sightings;
  };
  std::vector<std::uint8_t> is_expected(sightings_.size(), 0);
  for (const ExpectedPoint& expected : current.expected) {
    ++entry(expected.point).expected;
    is_expected[expected.point.index()] = 1;
  }
  for (const Landmark& match : current.estimate.matches) {
    if (match.kind != Landmark::Kind::kMapPoint) continue;
    PointSightings& sightings = entry(match.point);
    ++sightings.found;
    if (is_expected[match.point.index()] == 0) ++sightings.expected;
  }
}

std::vector<PointSightings> Tracker::TakeSightings() {
  std::vector<PointSightings> taken;
  taken.reserve(sighted_.size());
  for (const PointId id : sighted_) {
    taken.push_back(sightings_[id.index()]);
    sightings_[id.index()] = PointSightings{};
  }
  sighted_.clear();
  return taken;
}

void Tracker::FailToTrack(CurrentFrame& current, std::string reason) {
  current.result.num_inliers = current.estimate.num_inliers();
  const bool give_up = !current.T_world_last || current.since_last_s > options_.recently_lost_s;
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
  proposal.sightings = TakeSightings();
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
  const bool continues =
      last_data_ != nullptr && current.T_world_last && current.since_last_s > 0.0;
  if (continues) {
    velocity_ = Log(current.T_world_last->Inverse() * T_world_camera) / current.since_last_s;
  } else {
    velocity_.reset();
  }
  const Se3 T_world_reference =
      history_.T_world_keyframe(snapshot_->map, current.reference).value();
  history_.SetLast(current.reference, T_world_reference.Inverse() * T_world_camera);
  last_data_ = current.data;
  last_points_ = PointIds(current.estimate.matches);
  last_tracked_ = current.data->stamp;
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
