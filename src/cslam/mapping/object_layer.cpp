// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/object_layer.h"

#include "cslam/mapping/object_displacement.h"
#include "cslam/mapping/object_geometry.h"
#include "cslam/mapping/object_parting.h"
#include "cslam/mapping/object_points.h"
#include "cslam/mapping/structure_refinement.h"

#include <algorithm>
#include <cmath>

namespace cslam {
namespace {

BeliefCause CauseOf(const ObjectEvidence& evidence) {
  if (evidence.num_through > 0 && evidence.log_ratio < 0.0) return BeliefCause::kLookedThrough;
  return evidence.num_seen > 0 && evidence.log_ratio > 0.0 ? BeliefCause::kSeen
                                                           : BeliefCause::kMissed;
}

// Nobody believed in what was suspected there long ago: what is seen there now may well be new.
void ForgetFirstSight(MapObject& object, const Map& map, KeyframeId keyframe, Stamp seen,
                      double after_s) {
  if (object.state != ObjectState::kCandidate || object.num_sightings == 0 ||
      !HasPassed(object.last_seen, seen, after_s)) {
    return;
  }
  object.first_keyframe = object.arrived_keyframe = keyframe;
  object.first_session = static_cast<std::uint32_t>(map.SessionOf(keyframe));
  object.first_seen = object.last_seen = seen;
}

// Of two that are one: since when it is there. What only one of them was believed to be, counts.
void TakeOverArrival(MapObject& keep, const MapObject& drop) {
  const bool is_believed = keep.state != ObjectState::kCandidate;
  const bool is_other_believed = drop.state != ObjectState::kCandidate;
  const bool takes_over = is_believed == is_other_believed
                              ? drop.first_keyframe < keep.first_keyframe
                              : is_other_believed;
  if (!takes_over) return;
  keep.first_keyframe = drop.first_keyframe;
  keep.arrived_keyframe = drop.arrived_keyframe;
  keep.first_session = drop.first_session;
  keep.first_seen = drop.first_seen;
}

// Of which less is left than any of the things shows that it was called.
bool IsSliver(const MapObject& object, const ObjectClasses& classes) {
  double min_extent_m = classes.MinExtentM(object.class_id);
  for (const MapObject::ClassVote& vote : object.votes) {
    const double of_vote_m = classes.MinExtentM(vote.class_id);
    if (of_vote_m > 0.0) min_extent_m = std::min(min_extent_m, of_vote_m);
  }
  if (object.box.size_m.maxCoeff() >= min_extent_m || !object.surface) return false;
  // The object's own box may be that of its map points.
  const std::vector<Eigen::Vector3f> points = TrustedPoints(*object.surface);
  return !points.empty() &&
         BoxAround(points, -Eigen::Vector3d::UnitY()).size_m.maxCoeff() < min_extent_m;
}

}  // namespace

ObjectLayer::ObjectLayer(const Camera& camera, const DepthOptions& depth,
                         const MapperOptions& options, const MeasurementModel& model)
    : camera_(camera),
      depth_(depth),
      options_(options),
      model_(model),
      classes_(options.objects.classes),
      belief_update_(BeliefUpdateOf(options.objects)),
      growth_(options_.objects, classes_),
      changes_(camera_, options_.objects, classes_),
      origins_(camera_, options_.objects, classes_, growth_, changes_) {}

void ObjectLayer::Reset() {
  origins_.Reset();
  objects_of_tracks_.clear();
  strays_.clear();
  up_sum_.clear();
}

// People hold cameras, and robots carry them, upright on the whole.
Eigen::Vector3d ObjectLayer::UpWorld() const {
  const auto up = up_sum_.find(map_id_);
  return up == up_sum_.end() || up->second.norm() < 1e-6
             ? Eigen::Vector3d(-Eigen::Vector3d::UnitY())
             : up->second.normalized();
}

ObjectLayerReport ObjectLayer::Update(Map& map, const KeyframeProposal& proposal) {
  ObjectLayerReport report;
  if (!options_.objects.enabled) return report;
  const Keyframe& keyframe = *map.FindKeyframe(proposal.id);
  const Se3 T_world_camera = keyframe.T_world_camera;
  map_id_ = keyframe.map;
  up_sum_.try_emplace(map_id_, Eigen::Vector3d::Zero()).first->second -=
      T_world_camera.rotation * Eigen::Vector3d::UnitY();

  const SeenBefore seen_before = WhenSeen(map, map_id_);
  report.num_changed += TakeEvidence(map, proposal);
  const DepthView& view = proposal.objects.view;
  if (view.empty()) return report;
  const auto sightings =
      PlaceSightings(proposal.objects.sightings, view, T_world_camera, classes_, options_.objects);
  const auto known = AssociateSightings(map, map_id_, sightings, view, T_world_camera, seen_before,
                                        classes_, options_.objects);
  std::vector<ObjectId> seen;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const TrackId track = sightings[i].sighting->track;
    if (!known[i] && IsPiece(sightings[i])) continue;
    if (!known[i] && IsOfKnownTrack(map, sightings[i]) &&
        ++strays_[track] < options_.objects.max_strays) {
      continue;
    }
    strays_.erase(track);
    const ObjectId id =
        known[i] ? *known[i] : map.AddObject(growth_.Begin(map, map_id_, proposal, sightings[i]));
    const PlacedSighting parted =
        PartFromOthers(map, map_id_, sightings[i], known[i] ? map.FindObject(id) : nullptr, view,
                       T_world_camera, classes_, options_.objects);
    MapObject object = *map.FindObject(id);
    ForgetFirstSight(object, map, proposal.id, proposal.data->stamp,
                     options_.objects.recognise_after_s);
    map.SetObject(growth_.WithSighting(map, std::move(object), proposal, parted, UpWorld()));
    report.num_new += known[i] ? 0 : 1;
    objects_of_tracks_[track] = id;
    seen.push_back(id);
  }
  for (const ObjectId id : seen) {
    JudgeArrival(map, id, proposal);
    report.num_changed += DisplaceOthers(map, id, proposal);
  }
  SweepLeftPlaces(map, proposal);
  const std::vector<PointId> points = map.FindKeyframe(proposal.id)->points;
  AssignPoints(map, proposal.id, points);
  report.num_changed += MergeDoubles(map, seen, proposal.data->stamp);
  origins_.Update(map, proposal.id, UpWorld());
  return report;
}

// What the tracker has followed without a break is no second thing: its region has run into
// something else, like the wall behind it. Unless it stays there: then it was the first one that
// was something else, like the arm of the chair that a bear sits in.
bool ObjectLayer::IsOfKnownTrack(const Map& map, const PlacedSighting& sighting) const {
  const auto known = objects_of_tracks_.find(sighting.sighting->track);
  const MapObject* object =
      known == objects_of_tracks_.end() ? nullptr : map.FindObject(known->second);
  return object != nullptr && object->map == map_id_ && object->state != ObjectState::kAbsent &&
         object->num_sightings > 1;
}

bool ObjectLayer::IsPiece(const PlacedSighting& sighting) const {
  return sighting.extent_m < classes_.MinExtentM(sighting.sighting->class_id);
}

void ObjectLayer::AssignPoints(Map& map, KeyframeId keyframe,
                               std::span<const PointId> points) const {
  if (options_.objects.enabled)
    cslam::AssignPoints(map, keyframe, points, objects_of_tracks_, classes_);
}

// Whether evidence counts now: always, or (the paper) only at the first sight after a while.
bool ObjectLayer::MayUpdate(const Map& map, const MapObject& object, KeyframeId keyframe) const {
  if (belief_update_ == BeliefUpdate::kPerView || object.state == ObjectState::kCandidate) {
    return true;
  }
  int between = 0;
  for (std::size_t i = object.last_keyframe.index() + 1; i < keyframe.index(); ++i)
    between += map.KeyframeSlot(i).id.valid() ? 1 : 0;
  return between >= options_.objects.visit_gap_keyframes;
}

// All of it is taken in before anything is decided: what follows for one thing may depend on when
// another was seen.
int ObjectLayer::TakeEvidence(Map& map, const KeyframeProposal& proposal) const {
  std::vector<std::pair<ObjectId, const ObjectEvidence*>> taken;
  for (const ObjectEvidence& evidence : proposal.objects.evidence) {
    const auto id = map.Resolve(evidence.object);
    if (!id) continue;
    MapObject object = *map.FindObject(*id);
    if (!MayUpdate(map, object, proposal.id)) continue;
    object.log_odds = UpdatedLogOdds(object.log_odds, evidence.log_ratio, options_.objects.belief);
    if (evidence.last_seen) {
      ForgetFirstSight(object, map, proposal.id, *evidence.last_seen,
                       options_.objects.recognise_after_s);
      object.last_seen = std::max(object.last_seen, *evidence.last_seen);
    }
    object.num_named_views += evidence.num_seen;
    object.num_unnamed_views += evidence.num_missed;
    if (evidence.log_ratio != 0.0) NoteBelief(object, proposal.data->stamp, CauseOf(evidence));
    map.SetObject(std::move(object));
    taken.emplace_back(*id, &evidence);
  }
  int changed = 0;
  for (const auto& [id, evidence] : taken) {
    const MapObject* object = map.FindObject(id);
    if (object == nullptr) continue;
    if (IsMistake(*object)) {
      EraseMistake(
          map, id,
          evidence->num_through > 0 ? Map::PointsOfErased::kErase : Map::PointsOfErased::kKeep);
      ++changed;
      continue;
    }
    changed += Decide(map, id, proposal, *evidence) ? 1 : 0;
  }
  return changed;
}

// What a detector named once or twice and hardly ever since, though it stood before it; or of which
// little is left, once what belongs to other things was taken away.
bool ObjectLayer::IsMistake(const MapObject& object) const {
  if (object.state != ObjectState::kPresent) return false;
  if (IsSliver(object, classes_)) return true;
  const int num_views = object.num_named_views + object.num_unnamed_views;
  return num_views >= options_.objects.min_doubt_views &&
         object.num_named_views < options_.objects.min_named_share * num_views;
}

void ObjectLayer::EraseMistake(Map& map, ObjectId id, Map::PointsOfErased points) const {
  changes_.OnMistake(map, id);
  map.EraseObject(id, points);
}

// Draws the consequences of a belief. Returns whether there were any.
bool ObjectLayer::Decide(Map& map, ObjectId id, const KeyframeProposal& proposal,
                         const ObjectEvidence& evidence) const {
  const PersistenceOptions& belief = options_.objects.belief;
  MapObject object = *map.FindObject(id);
  const Stamp now = proposal.data->stamp;
  const auto session = static_cast<std::uint32_t>(map.SessionOf(proposal.id));
  const double value = BeliefOf(object);
  if (value >= belief.activate_at && !object.is_active) {
    const bool is_arrival = object.state != ObjectState::kPresent;
    if (object.state == ObjectState::kAbsent) object.arrived_keyframe = proposal.id;
    object.state = ObjectState::kPresent;
    map.SetObject(object);
    Activate(map, id);
    if (is_arrival) changes_.OnArrived(map, id, now, session);
    object = *map.FindObject(id);
    object.absent_since.reset();
    map.SetObject(std::move(object));
    return true;
  }
  if (value < belief.absent_at && object.state == ObjectState::kPresent) {
    object.state = ObjectState::kAbsent;
    object.is_active = false;
    object.absent_since = evidence.first_through.value_or(now);
    map.SetObject(std::move(object));
    // Not left to SweepLeftPlaces(): the first look through may be long ago, or by another clock.
    SweepPlaces(map, {&id, 1}, proposal, options_.objects);
    changes_.OnGone(map, id, now, evidence.num_through, session);
    return true;
  }
  if (value < belief.erase_at && object.state == ObjectState::kCandidate) {
    const bool was_looked_through = evidence.num_through > 0;
    map.EraseObject(id,
                    was_looked_through ? Map::PointsOfErased::kErase : Map::PointsOfErased::kKeep);
    return true;
  }
  if (value < belief.deactivate_at && object.is_active) {
    object.is_active = false;
    map.SetObject(std::move(object));
    return true;
  }
  return false;
}

// At first sight little of a thing is known, and little of it may be right. So whether it is new
// here is asked again until it has been seen well; and what is new, whether it came from elsewhere.
void ObjectLayer::JudgeArrival(Map& map, ObjectId id, const KeyframeProposal& proposal) const {
  const MapObject& object = *map.FindObject(id);
  if (object.state != ObjectState::kPresent || object.absent_since || object.num_sightings < 2)
    return;
  const Stamp now = proposal.data->stamp;
  if (object.num_sightings > options_.objects.settled_sightings) {
    changes_.OnSeenAgain(map, id, now);
    return;
  }
  changes_.OnArrived(map, id, now, static_cast<std::uint32_t>(map.SessionOf(proposal.id)));
}

void ObjectLayer::Activate(Map& map, ObjectId id) const {
  const std::vector<PointId> points = map.PointsOfObject(id);
  RefineStructure(map, points, camera_, depth_, model_, options_.local_ba.solver);
  MapObject object = *map.FindObject(id);
  object.is_active = true;
  map.SetObject(std::move(object));
}

// Little of a place may have been in view when it was found empty.
void ObjectLayer::SweepLeftPlaces(Map& map, const KeyframeProposal& proposal) const {
  std::vector<ObjectId> left;
  for (const ObjectId id : map.Objects()) {
    const MapObject& object = *map.FindObject(id);
    if (object.map != map_id_ || object.state != ObjectState::kAbsent || !object.absent_since)
      continue;
    const double since_s = SecondsBetween(proposal.data->stamp, *object.absent_since);
    if (since_s >= 0.0 && since_s <= options_.objects.sweep_for_s) left.push_back(id);
  }
  SweepPlaces(map, left, proposal, options_.objects);
}

// What stood where a new thing stands, and has not been seen since, is gone.
int ObjectLayer::DisplaceOthers(Map& map, ObjectId id, const KeyframeProposal& proposal) const {
  const Displacement found = FindDisplaced(map, id, proposal, classes_, options_.objects);
  for (const ObjectId other_id : found.still_there) {
    MapObject other = *map.FindObject(other_id);
    other.last_keyframe = proposal.id;
    map.SetObject(std::move(other));
  }
  for (const ObjectId other_id : found.gone) {
    MapObject other = *map.FindObject(other_id);
    if (IsMistake(other)) {
      EraseMistake(map, other_id, Map::PointsOfErased::kErase);
      continue;
    }
    other.state = ObjectState::kAbsent;
    other.is_active = false;
    other.log_odds = std::min(other.log_odds, LogOdds(options_.objects.belief.absent_at));
    other.absent_since = map.FindObject(id)->first_seen;
    NoteBelief(other, proposal.data->stamp, BeliefCause::kDisplaced);
    map.SetObject(std::move(other));
    changes_.OnDisplaced(map, other_id, id, proposal.data->stamp,
                         static_cast<std::uint32_t>(map.SessionOf(proposal.id)));
  }
  return static_cast<int>(found.gone.size());
}

int ObjectLayer::MergeAllDoubles(Map& map) {
  if (!options_.objects.enabled) return 0;
  return MergeDoubles(map, map.Objects(), {});
}

int ObjectLayer::MergeDoubles(Map& map, std::span<const ObjectId> seen, Stamp now) {
  int merged = 0;
  for (const ObjectId id : seen) {
    const MapObject* object = map.FindObject(id);
    if (object == nullptr) continue;
    const auto twin = FindDouble(map, *object, classes_, options_.objects);
    if (!twin) continue;
    const ObjectId keep_id = std::min(id, *twin);
    const ObjectId drop_id = std::max(id, *twin);
    MapObject keep = *map.FindObject(keep_id);
    const MapObject drop = *map.FindObject(drop_id);
    const Se3 T_keep_drop = map.T_world_object(keep).Inverse() * map.T_world_object(drop);
    keep.surface =
        std::make_shared<const ObjectSurface>(Joined(*keep.surface, *drop.surface, T_keep_drop));
    keep.log_odds = std::max(keep.log_odds, drop.log_odds);
    for (const MapObject::ClassVote& vote : drop.votes)
      AddVote(keep, vote);
    keep.num_sightings += drop.num_sightings;
    keep.num_named_views += drop.num_named_views;
    keep.num_unnamed_views += drop.num_unnamed_views;
    keep.last_keyframe = std::max(keep.last_keyframe, drop.last_keyframe);
    keep.last_seen = drop.last_keyframe < keep.last_keyframe ? keep.last_seen : drop.last_seen;
    keep.track = drop.track;
    TakeOverArrival(keep, drop);
    const bool becomes_present =
        keep.state != ObjectState::kPresent && drop.state == ObjectState::kPresent;
    if (becomes_present) keep.state = ObjectState::kPresent;
    NoteBelief(keep, std::max({now, keep.last_seen, drop.last_seen}), BeliefCause::kMerged);
    keep = growth_.Measured(map, std::move(keep), UpWorld());
    const bool is_active = keep.is_active || drop.is_active;
    map.SetObject(keep);
    map.MergeObjects(keep_id, drop_id);
    if (is_active) Activate(map, keep_id);
    changes_.OnMerged(map, keep_id, drop_id);
    for (auto& [track, object_id] : objects_of_tracks_) {
      if (object_id == drop_id) object_id = keep_id;
    }
    ++merged;
  }
  return merged;
}

}  // namespace cslam
