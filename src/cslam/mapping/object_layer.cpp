// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/object_layer.h"

#include "cslam/mapping/object_geometry.h"
#include "cslam/mapping/structure_refinement.h"

#include <algorithm>
#include <cmath>

namespace cslam {
namespace {

constexpr std::size_t kMaxHistory = 500;  // belief samples kept of one object

// Small things need small cells.
double VoxelM(double class_distance_m, const MapObjectOptions& options) {
  return std::min(options.voxel_m, std::max(0.01, 0.05 * class_distance_m));
}

void Vote(MapObject& object, const ObjectSighting& sighting) {
  const auto class_id = static_cast<std::int16_t>(sighting.class_id);
  auto vote = std::find_if(object.votes.begin(), object.votes.end(),
                           [&](const auto& v) { return v.class_id == class_id; });
  if (vote == object.votes.end()) vote = object.votes.insert(vote, {class_id, 0.0F});
  vote->weight += static_cast<float>(sighting.score);
  std::stable_sort(object.votes.begin(), object.votes.end(),
                   [](const auto& a, const auto& b) { return a.weight > b.weight; });
  object.class_id = object.votes.front().class_id;
}

void MixColours(MapObject& object, const ColourHistogram& colours) {
  const float share = 1.0F / static_cast<float>(object.num_sightings + 1);
  for (std::size_t i = 0; i < colours.size(); ++i)
    object.colours[i] += share * (colours[i] - object.colours[i]);
}

void Note(MapObject& object, Stamp now, BeliefCause cause) {
  const auto belief = static_cast<float>(BeliefOf(object));
  if (!object.history.empty() && object.history.back().belief == belief &&
      object.history.back().cause == cause) {
    object.history.back().stamp = now;
    return;
  }
  if (object.history.size() >= kMaxHistory) object.history.erase(object.history.begin() + 1);
  object.history.push_back({now, belief, cause});
}

BeliefCause CauseOf(const ObjectEvidence& evidence) {
  if (evidence.num_through > 0 && evidence.log_ratio < 0.0) return BeliefCause::kLookedThrough;
  return evidence.num_seen > 0 && evidence.log_ratio > 0.0 ? BeliefCause::kSeen
                                                           : BeliefCause::kMissed;
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
      extent_source_(ExtentSourceOf(options.objects)),
      changes_(camera_, options_.objects, classes_) {}

void ObjectLayer::Reset() {
  objects_of_tracks_.clear();
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

  report.num_changed += TakeEvidence(map, proposal);
  const DepthView& view = proposal.objects.view;
  if (view.empty()) return report;
  const auto sightings =
      PlaceSightings(proposal.objects.sightings, view, T_world_camera, classes_, options_.objects);
  const auto known =
      AssociateSightings(map, map_id_, sightings, view, T_world_camera, classes_, options_.objects);
  std::vector<ObjectId> seen;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (!known[i] && (IsOfKnownTrack(map, sightings[i]) || IsPiece(sightings[i]))) continue;
    const ObjectId id = known[i] ? *known[i] : AddObject(map, proposal, sightings[i]);
    if (known[i]) Renew(map, id, proposal, sightings[i]);
    report.num_new += known[i] ? 0 : 1;
    objects_of_tracks_[sightings[i].sighting->track] = id;
    seen.push_back(id);
  }
  for (const ObjectId id : seen) {
    JudgeArrival(map, id, proposal);
    report.num_changed += DisplaceOthers(map, id, proposal);
  }
  AssignKeypoints(map, proposal.id);
  report.num_changed += MergeDoubles(map, seen, proposal.data->stamp);
  return report;
}

// What the tracker has followed without a break is no second thing: its region has run into
// something else, like the wall behind it.
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

ObjectId ObjectLayer::AddObject(Map& map, const KeyframeProposal& proposal,
                                const PlacedSighting& sighting) const {
  MapObject object;
  object.map = map_id_;
  object.class_id = sighting.sighting->class_id;
  object.reference = proposal.id;
  ObjectSurface surface;
  surface.voxel_m = VoxelM(classes_.DistanceM(object.class_id), options_.objects);
  object.surface = std::make_shared<const ObjectSurface>(std::move(surface));
  object.first_box = sighting.sighting->box;
  object.first_keyframe = proposal.id;
  object.arrived_keyframe = proposal.id;
  object.first_seen = sighting.sighting->detected;
  object.first_session = static_cast<std::uint32_t>(map.SessionOf(proposal.id));
  Note(object, proposal.data->stamp, BeliefCause::kCreated);
  const ObjectId id = map.AddObject(std::move(object));
  Renew(map, id, proposal, sighting);
  return id;
}

void ObjectLayer::Renew(Map& map, ObjectId id, const KeyframeProposal& proposal,
                        const PlacedSighting& sighting) const {
  MapObject object = *map.FindObject(id);
  const Se3 T_object_camera =
      map.T_world_object(object).Inverse() * map.FindKeyframe(proposal.id)->T_world_camera;
  const double depth_m = static_cast<double>(sighting.sighting->region.median_m);
  const double tolerance_m = options_.objects.view.tolerance_m +
                             options_.objects.view.tolerance_per_m2 * depth_m * depth_m;
  object.surface = std::make_shared<const ObjectSurface>(
      WithView(*object.surface, sighting.points_camera, T_object_camera, proposal.objects.view,
               sighting.sighting->region, tolerance_m));
  MixColours(object, sighting.sighting->colours);
  Vote(object, *sighting.sighting);
  object.current_box = sighting.sighting->box;
  object.track = sighting.sighting->track;
  object.last_keyframe = proposal.id;
  object.last_seen = proposal.data->stamp;
  object.last_session = static_cast<std::uint32_t>(map.SessionOf(proposal.id));
  ++object.num_sightings;
  Measure(map, object);
  map.SetObject(std::move(object));
}

void ObjectLayer::Measure(const Map& map, MapObject& object) const {
  const std::vector<Eigen::Vector3f> trusted = TrustedPoints(*object.surface);
  if (trusted.empty()) return;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& p : trusted)
    sum += p.cast<double>();
  object.centroid = sum / static_cast<double>(trusted.size());
  const Eigen::Vector3d up = map.T_world_object(object).R().transpose() * UpWorld();
  object.box = BoxAround(trusted, up);
  if (extent_source_ == ExtentSource::kPoints) MeasureByPoints(map, object);
}

void ObjectLayer::MeasureByPoints(const Map& map, MapObject& object) const {
  std::vector<Eigen::Vector3d> points;
  for (const PointId id : map.PointsOfObject(object.id))
    points.push_back(map.FindPoint(id)->p_world);
  if (points.empty()) return;
  const Se3 T_object_world = map.T_world_object(object).Inverse();
  const Eigen::AlignedBox3d extent = ExtentOfPoints(points);
  object.centroid = T_object_world * CentroidOfPoints(points);
  object.box.center = T_object_world * extent.center().eval();
  object.box.size_m = extent.sizes();
  object.box.rotation = T_object_world.rotation;
}

// A point is an object's if at least half of the keyframes that see it see it on such a thing.
bool ObjectLayer::ShouldBelong(const Map& map, const MapPoint& point, ObjectId object) const {
  const int class_id = map.FindObject(object)->class_id;
  int on = 0;
  for (const PointObservation& o : point.observations) {
    const KeypointSemantics& semantics =
        map.FindKeyframe(o.keyframe)
            ->data->features.semantics[static_cast<std::size_t>(o.keypoint)];
    on += semantics.class_id >= 0 && classes_.AreAlike(semantics.class_id, class_id) ? 1 : 0;
  }
  return 2 * on >= static_cast<int>(point.observations.size());
}

void ObjectLayer::AssignKeypoints(Map& map, KeyframeId keyframe) const {
  const std::vector<PointId> points = map.FindKeyframe(keyframe)->points;
  AssignPoints(map, keyframe, points);
}

void ObjectLayer::AssignPoints(Map& map, KeyframeId keyframe,
                               std::span<const PointId> points) const {
  if (!options_.objects.enabled || objects_of_tracks_.empty()) return;
  for (const PointId id : points) {
    const MapPoint* point = id.valid() ? map.FindPoint(id) : nullptr;
    if (point == nullptr || point->object.valid()) continue;
    const auto seen =
        std::find_if(point->observations.begin(), point->observations.end(),
                     [&](const PointObservation& o) { return o.keyframe == keyframe; });
    if (seen == point->observations.end()) continue;
    const KeypointSemantics& semantics =
        map.FindKeyframe(keyframe)
            ->data->features.semantics[static_cast<std::size_t>(seen->keypoint)];
    const auto object = objects_of_tracks_.find(semantics.track);
    if (object == objects_of_tracks_.end() || map.FindObject(object->second) == nullptr) continue;
    if (ShouldBelong(map, *point, object->second)) map.AssignPoint(id, object->second);
  }
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

int ObjectLayer::TakeEvidence(Map& map, const KeyframeProposal& proposal) const {
  int changed = 0;
  for (const ObjectEvidence& evidence : proposal.objects.evidence) {
    const auto id = map.Resolve(evidence.object);
    if (!id) continue;
    MapObject object = *map.FindObject(*id);
    if (!MayUpdate(map, object, proposal.id)) continue;
    object.log_odds = UpdatedLogOdds(object.log_odds, evidence.log_ratio, options_.objects.belief);
    if (evidence.last_seen) object.last_seen = std::max(object.last_seen, *evidence.last_seen);
    Note(object, proposal.data->stamp, CauseOf(evidence));
    map.SetObject(std::move(object));
    changed += Decide(map, *id, proposal, evidence) ? 1 : 0;
  }
  return changed;
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
    SweepPlace(map, id, proposal);
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
// here is asked again until it has been seen well.
void ObjectLayer::JudgeArrival(Map& map, ObjectId id, const KeyframeProposal& proposal) const {
  const MapObject& object = *map.FindObject(id);
  if (object.state != ObjectState::kPresent || object.absent_since || object.num_sightings < 2 ||
      object.num_sightings > options_.objects.settled_sightings) {
    return;
  }
  changes_.OnArrived(map, id, proposal.data->stamp,
                     static_cast<std::uint32_t>(map.SessionOf(proposal.id)));
}

void ObjectLayer::Activate(Map& map, ObjectId id) const {
  const std::vector<PointId> points = map.PointsOfObject(id);
  RefineStructure(map, points, camera_, depth_, model_, options_.local_ba.solver);
  MapObject object = *map.FindObject(id);
  object.is_active = true;
  map.SetObject(std::move(object));
}

// Points that nobody had named, in the box of a thing that is gone, and looked through as well.
void ObjectLayer::SweepPlace(Map& map, ObjectId id, const KeyframeProposal& proposal) const {
  constexpr double kMarginM = 0.05;
  const MapObject& object = *map.FindObject(id);
  const DepthView& view = proposal.objects.view;
  if (view.empty()) return;
  const Se3 T_object_world = map.T_world_object(object).Inverse();
  const Se3 T_camera_world = map.FindKeyframe(proposal.id)->T_world_camera.Inverse();
  const Eigen::Vector3d half = 0.5 * object.box.size_m + Eigen::Vector3d::Constant(kMarginM);
  const Eigen::Matrix3d R_box = object.box.rotation.toRotationMatrix().transpose();
  const DepthSampler sampler{&view.depth_mm, view.step, &view.camera, false};
  for (std::size_t i = 0; i < map.num_point_ids(); ++i) {
    const MapPoint* point = map.FindPoint(PointId(static_cast<std::uint32_t>(i)));
    if (point == nullptr || point->object.valid() || point->map != object.map) continue;
    const Eigen::Vector3d p = T_object_world * point->p_world;
    const Eigen::Vector3d p_box = R_box * (p - object.box.center);
    if ((p_box.cwiseAbs().array() > half.array()).any()) continue;
    const Eigen::Vector3f sample = point->p_world.cast<float>();
    const ExpectedView seen =
        LookAtPlace({&sample, 1}, T_camera_world, sampler, 0.0, options_.objects.view);
    if (seen.num_through > 0) map.AssignPoint(point->id, id);
  }
}

// Share of the object's surface inside the other's box.
double ObjectLayer::ShareInside(const Map& map, const MapObject& object,
                                const MapObject& other) const {
  const Se3 T_other_object = map.T_world_object(other).Inverse() * map.T_world_object(object);
  const Eigen::Matrix3d R_box = other.box.rotation.toRotationMatrix().transpose();
  int inside = 0;
  for (const Eigen::Vector3f& sample : object.surface->samples) {
    const Eigen::Vector3d p = R_box * (T_other_object * sample.cast<double>() - other.box.center);
    inside += (p.cwiseAbs().array() <= 0.5 * other.box.size_m.array()).all() ? 1 : 0;
  }
  return static_cast<double>(inside) /
         static_cast<double>(std::max<std::size_t>(1, object.surface->samples.size()));
}

// Whether some of it is still to be seen in the keyframe.
bool ObjectLayer::IsSeenStanding(const Map& map, const MapObject& object,
                                 const KeyframeProposal& proposal) const {
  constexpr double kMaxStanding = 0.05;  // of the samples
  const DepthView& view = proposal.objects.view;
  if (view.empty()) return false;
  const Se3 T_camera_object =
      map.FindKeyframe(proposal.id)->T_world_camera.Inverse() * map.T_world_object(object);
  const DepthSampler sampler{&view.depth_mm, view.step, &view.camera, false};
  const ExpectedView seen =
      LookAtPlace(object.surface->samples, T_camera_object, sampler, 0.0, options_.objects.view);
  return seen.num_standing > kMaxStanding * seen.num_samples &&
         seen.num_standing > seen.num_through;
}

// What stood where a new thing stands, and has not been seen since, is gone. Large things first:
// of a chair with a bear on it the chair was replaced.
int ObjectLayer::DisplaceOthers(Map& map, ObjectId id, const KeyframeProposal& proposal) const {
  const MapObject& comer = *map.FindObject(id);
  if (comer.state != ObjectState::kPresent ||
      comer.num_sightings < options_.objects.min_displacing_views) {
    return 0;
  }
  std::vector<std::pair<double, ObjectId>> displaced;
  std::vector<ObjectId> still_there;
  for (const ObjectId other_id : map.Objects()) {
    const MapObject& other = *map.FindObject(other_id);
    if (other_id == id || other.map != comer.map || other.state != ObjectState::kPresent ||
        !other.surface || !(other.last_keyframe < comer.arrived_keyframe) ||
        classes_.AreAlike(other.class_id, comer.class_id)) {
      continue;
    }
    if (ShareInside(map, other, comer) < options_.objects.min_displaced) continue;
    if (IsSeenStanding(map, other, proposal)) {
      still_there.push_back(other_id);
      continue;
    }
    displaced.emplace_back(-other.box.size_m.prod(), other_id);
  }
  for (const ObjectId other_id : still_there) {
    MapObject other = *map.FindObject(other_id);
    other.last_keyframe = proposal.id;
    map.SetObject(std::move(other));
  }
  std::sort(displaced.begin(), displaced.end());
  for (const auto& [volume, other_id] : displaced) {
    MapObject other = *map.FindObject(other_id);
    other.state = ObjectState::kAbsent;
    other.is_active = false;
    other.log_odds = std::min(other.log_odds, LogOdds(options_.objects.belief.absent_at));
    other.absent_since = map.FindObject(id)->first_seen;
    Note(other, proposal.data->stamp, BeliefCause::kDisplaced);
    map.SetObject(std::move(other));
    changes_.OnDisplaced(map, other_id, id, proposal.data->stamp,
                         static_cast<std::uint32_t>(map.SessionOf(proposal.id)));
  }
  return static_cast<int>(displaced.size());
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
    keep.num_sightings += drop.num_sightings;
    keep.last_keyframe = std::max(keep.last_keyframe, drop.last_keyframe);
    keep.last_seen = drop.last_keyframe < keep.last_keyframe ? keep.last_seen : drop.last_seen;
    keep.track = drop.track;
    const bool becomes_present =
        keep.state != ObjectState::kPresent && drop.state == ObjectState::kPresent;
    if (becomes_present) keep.state = ObjectState::kPresent;
    Note(keep, std::max({now, keep.last_seen, drop.last_seen}), BeliefCause::kMerged);
    Measure(map, keep);
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
