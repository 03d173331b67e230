// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/tracking/object_watch.h"

#include "cslam/util/options.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cslam {
void Describe(OptionList& list, ObjectWatchOptions& o) {
  list.Add("enabled", o.enabled, "Gather evidence for and against the objects of the map.");
  list.Add("view_interval", o.view_interval_s, {0.0, 60.0}, "s",
           "Views of an object closer in time are one: their errors are the same.");
  list.Add("max_turn_rate", o.max_turn_rate_dps, {1.0, 10'000.0}, "deg/s",
           "While the camera turns faster nothing is judged: colour and depth of a frame are not "
           "taken at the same time.");
  list.Add("pose_sigma", o.pose_sigma_m, {0.0, 10.0}, "m",
           "Uncertainty of a pose with one inlier, falling with the square root of their number; "
           "depth must differ by more.");
  list.Add("max_miss_depth", o.max_miss_depth_m, {0.0, 20.0}, "m",
           "Farther away a detector may miss a thing without that saying anything.");
  list.Add("force", o.force_log_ratio, {0.1, 100.0}, "",
           "A keyframe is proposed at once when so much evidence (log of the likelihood ratio) "
           "contradicts the map.");
  list.Add("new_after", o.new_after_s, {0.0, 60.0}, "s",
           "... and when a thing has been detected for so long that is not in the map.");
}

ObjectWatch::ObjectWatch(const ObjectWatchOptions& options)
    : options_(options), classes_(options.classes) {}

void ObjectWatch::Clear() {
  watched_.clear();
  told_.clear();
  newest_detections_.reset();
  T_world_last_.reset();
}

void ObjectWatch::Look(const WatchedFrame& frame, const MapView& map) {
  if (!options_.enabled) return;
  has_new_detections_ = frame.detections && frame.detections != newest_detections_;
  newest_detections_ = frame.detections;
  double turn_rate_dps = 0.0;
  const double dt_s = T_world_last_ ? SecondsBetween(frame.stamp, last_stamp_) : 0.0;
  if (dt_s > 0.0) {
    const Vector6 moved = Log(T_world_last_->Inverse() * frame.T_world_camera);
    turn_rate_dps = moved.head<3>().norm() / dt_s * 180.0 / std::numbers::pi;
  }
  T_world_last_ = frame.T_world_camera;
  last_stamp_ = frame.stamp;
  if (turn_rate_dps > options_.max_turn_rate_dps || frame.view->empty()) return;
  std::vector<ViewedObject> viewed = ViewObjects(frame, map);
  ShareSightings(frame, viewed);
  for (const ViewedObject& one : viewed)
    Judge(one, frame);
  LookForNew(frame, map);
}

bool ObjectWatch::ViewedObject::MayBeThere() const {
  return expected.through_share() < 0.5 &&
         (object->state != ObjectState::kAbsent || expected.verdict == PlaceVerdict::kStanding);
}

std::vector<ObjectWatch::ViewedObject> ObjectWatch::ViewObjects(const WatchedFrame& frame,
                                                                const MapView& map) const {
  const double pose_sigma_m =
      options_.pose_sigma_m / std::sqrt(static_cast<double>(std::max(1, frame.num_inliers)));
  std::vector<ViewedObject> viewed;
  std::map<int, cv::Mat> others_of_class;
  for (std::size_t i = 0; i < map.num_object_ids(); ++i) {
    const MapObject& object = map.ObjectSlot(i);
    if (!object.IsAlive() || object.map != frame.map || !object.surface) continue;
    const Se3 T_camera_object = frame.T_world_camera.Inverse() * map.T_world_object(object);
    const Eigen::Vector3d centroid = T_camera_object * object.centroid;
    if (centroid.z() < 0.1 || centroid.z() > options_.view.max_depth_m) continue;
    const auto [others, is_first_of_class] = others_of_class.try_emplace(object.class_id);
    if (is_first_of_class)
      others->second = CoveredByOthers(frame.sightings, object.class_id, classes_);
    const DepthSampler sampler{&frame.view->depth_mm, frame.view->step, &frame.view->camera, false,
                               &others->second};
    viewed.push_back({&object, T_camera_object, centroid,
                      LookAtPlace(object.surface->samples, T_camera_object, sampler, pose_sigma_m,
                                  options_.view)});
  }
  return viewed;
}

// Gives each sighting to one object of a class alike, within its distance: the one whose standing
// surface the sighting covers most and whose centre is nearest. What a chair's sighting says of
// the chair it does not say of something beside it that once passed for one.
void ObjectWatch::ShareSightings(const WatchedFrame& frame,
                                 std::vector<ViewedObject>& viewed) const {
  std::vector<double> best_cost(viewed.size(), std::numeric_limits<double>::max());
  for (const ObjectSighting& sighting : frame.sightings) {
    std::optional<std::size_t> owner;
    double least_cost = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < viewed.size(); ++i) {
      ViewedObject& one = viewed[i];
      if (!classes_.AreAlike(sighting.class_id, one.object->class_id)) continue;
      const double limit_m = classes_.DistanceM(one.object->class_id);
      const double distance_m = (sighting.region.centre_camera - one.centroid_camera).norm();
      if (distance_m > limit_m || !one.MayBeThere()) continue;
      const StandingSurface standing =
          FindStanding(one.object->surface->samples, one.T_camera_object, *frame.view,
                       sighting.region.mask, options_.view);
      const double cost = distance_m / limit_m - standing.covered_share();
      if (cost >= least_cost) continue;
      least_cost = cost;
      owner = i;
    }
    if (!owner || least_cost >= best_cost[*owner]) continue;
    best_cost[*owner] = least_cost;
    viewed[*owner].sighting = &sighting;
  }
}

void ObjectWatch::Judge(const ViewedObject& viewed, const WatchedFrame& frame) {
  const MapObject& object = *viewed.object;
  Watched& watched = watched_.try_emplace(object.id).first->second;
  watched.evidence.object = object.id;
  ObjectEvidence& evidence = watched.evidence;
  if (watched.last_view && !HasPassed(*watched.last_view, frame.stamp, options_.view_interval_s)) {
    return;
  }

  if (viewed.expected.verdict == PlaceVerdict::kLookedThrough) {
    if (object.state == ObjectState::kAbsent) return;
    evidence.log_ratio += LookedThroughLogRatio(options_.belief);
    ++evidence.num_through;
    if (!evidence.first_through) evidence.first_through = frame.stamp;
    watched.last_view = frame.stamp;
    return;
  }
  if (const ObjectSighting* sighting = viewed.sighting) {
    if (watched.last_detection == sighting->detected) return;
    const double distance_m = (sighting->region.centre_camera - viewed.centroid_camera).norm();
    evidence.log_ratio += SeenLogRatio(distance_m / classes_.DistanceM(object.class_id),
                                       sighting->score, options_.belief);
    ++evidence.num_seen;
    evidence.last_seen = frame.stamp;
    watched.last_detection = sighting->detected;
    watched.last_view = frame.stamp;
    return;
  }
  const bool stands_there = viewed.expected.verdict == PlaceVerdict::kStanding ||
                            viewed.expected.verdict == PlaceVerdict::kTaken;
  const bool should_be_named = stands_there && viewed.expected.num_outside == 0 &&
                               viewed.centroid_camera.z() < options_.max_miss_depth_m;
  if (should_be_named && has_new_detections_) {
    if (object.state == ObjectState::kCandidate)
      evidence.log_ratio += MissedLogRatio(options_.belief);
    ++evidence.num_missed;
    watched.last_view = frame.stamp;
  }
}

// Things that have been detected for a while and are nothing that the map knows.
void ObjectWatch::LookForNew(const WatchedFrame& frame, const MapView& map) {
  for (const ObjectSighting& sighting : frame.sightings) {
    if (!classes_.IsMapped(sighting.class_id) || told_.contains(sighting.track)) continue;
    if (SecondsBetween(sighting.detected, sighting.first_detected) < options_.new_after_s) continue;
    const Eigen::Vector3d centre_world = frame.T_world_camera * sighting.region.centre_camera;
    bool is_known = false;
    for (std::size_t i = 0; i < map.num_object_ids() && !is_known; ++i) {
      const MapObject& object = map.ObjectSlot(i);
      is_known =
          object.IsAlive() && object.map == frame.map && object.state != ObjectState::kAbsent &&
          classes_.AreAlike(object.class_id, sighting.class_id) &&
          (map.CentroidOf(object) - centre_world).norm() < classes_.DistanceM(object.class_id);
    }
    if (!is_known) told_[sighting.track] = false;
  }
}

bool ObjectWatch::HasNews(const MapView& map) const {
  for (const auto& [track, is_told] : told_) {
    if (!is_told) return true;
  }
  return std::any_of(watched_.begin(), watched_.end(), [&](const auto& entry) {
    const MapObject* object = map.FindObject(entry.first);
    if (object == nullptr) return false;
    const double log_ratio = entry.second.evidence.log_ratio;
    return object->state == ObjectState::kPresent ? log_ratio <= -options_.force_log_ratio
                                                  : log_ratio >= options_.force_log_ratio;
  });
}

std::vector<ObjectEvidence> ObjectWatch::Take() {
  std::vector<ObjectEvidence> taken;
  for (auto& [id, watched] : watched_) {
    const ObjectEvidence& evidence = watched.evidence;
    if (evidence.num_seen + evidence.num_missed + evidence.num_through > 0) {
      taken.push_back(evidence);
    }
    watched.evidence = ObjectEvidence{};
  }
  for (auto& [track, is_told] : told_)
    is_told = true;
  return taken;
}

}  // namespace cslam
