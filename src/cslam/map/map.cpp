// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/map/map.h"

#include "cslam/util/check.h"
#include "cslam/vision/matching.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cslam {
namespace {

auto LowerBound(std::vector<CovisibleKeyframe>& covisible, KeyframeId id) {
  return std::lower_bound(covisible.begin(), covisible.end(), id,
                          [](const CovisibleKeyframe& c, KeyframeId k) { return c.id < k; });
}

void ChangeWeight(std::vector<CovisibleKeyframe>& covisible, KeyframeId id, int change) {
  auto it = LowerBound(covisible, id);
  if (it == covisible.end() || it->id != id) it = covisible.insert(it, {id, 0});
  it->shared_points += change;
  if (it->shared_points == 0) covisible.erase(it);
}

}  // namespace

Map::Map(std::vector<double> level_scales) : level_scales_(std::move(level_scales)) {
  CSLAM_CHECK(!level_scales_.empty());
}

MapView Map::Snapshot() {
  Map copy(level_scales_);
  copy.keyframes_ = keyframes_.Share();
  copy.points_ = points_.Share();
  copy.objects_ = objects_.Share();
  copy.changes_ = changes_;
  copy.num_keyframes_ = num_keyframes_;
  copy.num_points_ = num_points_;
  copy.correction_epoch_ = correction_epoch_;
  copy.loops_ = loops_;
  copy.sessions_ = sessions_;
  return copy;
}

void Map::StartSession() {
  sessions_.emplace_back(static_cast<std::uint32_t>(keyframes_.size()));
}

void Map::Replace(Map other) {
  const std::uint32_t epoch = correction_epoch_;
  *this = std::move(other);
  correction_epoch_ = epoch + 1;
}

void Map::Clear() {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    MapPoint& point = points_.Edit(i);
    point.state = PointState::kErased;
    point.observations = {};
  }
  for (std::size_t i = 0; i < keyframes_.size(); ++i)
    keyframes_.Edit(i) = Keyframe{};
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    MapObject erased;
    erased.id = objects_[i].id;
    erased.state = ObjectState::kErased;
    objects_.Edit(i) = std::move(erased);
  }
  changes_.reset();
  num_keyframes_ = 0;
  num_points_ = 0;
  loops_.clear();
  AdvanceCorrectionEpoch();
}

MapPoint& Map::EditPoint(PointId id) {
  CSLAM_CHECK(FindPoint(id) != nullptr, "point {}", id.value());
  return points_.Edit(id.index());
}

Keyframe& Map::EditKeyframe(KeyframeId id) {
  CSLAM_CHECK(FindKeyframe(id) != nullptr, "keyframe {}", id.value());
  return keyframes_.Edit(id.index());
}

void Map::AddKeyframe(Keyframe keyframe) {
  CSLAM_CHECK(keyframe.id.valid() && keyframe.IsAlive() && keyframe.map.valid());
  CSLAM_CHECK(keyframe.id.index() >= keyframes_.size(), "keyframe {} exists", keyframe.id.value());
  CSLAM_CHECK(keyframe.points.empty() && keyframe.covisible.empty());
  CSLAM_CHECK(!keyframe.parent.valid() || FindKeyframe(keyframe.parent) != nullptr);
  while (keyframes_.size() < keyframe.id.index())
    keyframes_.PushBack(Keyframe{});
  keyframe.points.assign(keyframe.data->features.size(), PointId());
  keyframes_.PushBack(std::move(keyframe));
  ++num_keyframes_;
}

void Map::AddForward(KeyframeId id, KeyframeId forward_to, const Se3& T_forward_self) {
  CSLAM_CHECK(id.index() >= keyframes_.size() && Resolve(forward_to).has_value());
  while (keyframes_.size() < id.index())
    keyframes_.PushBack(Keyframe{});
  Keyframe forward;
  forward.id = id;
  forward.forward_to = forward_to;
  forward.T_forward_self = T_forward_self;
  keyframes_.PushBack(std::move(forward));
}

void Map::CullKeyframe(KeyframeId id) {
  const KeyframeId parent = EditKeyframe(id).parent;
  CSLAM_CHECK(parent.valid(), "keyframe {} is the first of its map", id.value());

  for (const KeyframeId child : Keyframes()) {
    if (FindKeyframe(child)->parent == id) EditKeyframe(child).parent = parent;
  }
  const std::vector<PointId> points = FindKeyframe(id)->points;
  for (const PointId point : points) {
    if (point.valid()) RemoveObservation(point, id);
  }
  const Se3 T_parent_culled =
      FindKeyframe(parent)->T_world_camera.Inverse() * FindKeyframe(id)->T_world_camera;
  Keyframe& keyframe = EditKeyframe(id);
  keyframe.forward_to = parent;
  keyframe.T_forward_self = T_parent_culled;
  keyframe.data.reset();
  keyframe.points = {};
  keyframe.covisible = {};
  --num_keyframes_;
}

PointId Map::AddPoint(const Eigen::Vector3d& p_world, KeyframeId keyframe) {
  const Keyframe* reference = FindKeyframe(keyframe);
  CSLAM_CHECK(reference != nullptr && p_world.allFinite());
  MapPoint point;
  point.id = PointId(static_cast<std::uint32_t>(points_.size()));
  point.map = reference->map;
  point.p_world = p_world;
  point.reference = keyframe;
  point.created_by = keyframe;
  const PointId id = point.id;
  points_.PushBack(std::move(point));
  ++num_points_;
  return id;
}

void Map::AddSharedPoint(KeyframeId a, KeyframeId b, int change) {
  ChangeWeight(EditKeyframe(a).covisible, b, change);
  ChangeWeight(EditKeyframe(b).covisible, a, change);
}

bool Map::AddObservation(PointId point, KeyframeId keyframe, int keypoint) {
  Keyframe& observer = EditKeyframe(keyframe);
  PointId& slot = observer.points.at(static_cast<std::size_t>(keypoint));
  if (slot.valid()) return false;
  MapPoint& landmark = EditPoint(point);
  CSLAM_CHECK(landmark.map == observer.map, "point and keyframe belong to different maps");
  auto& observations = landmark.observations;
  const auto at =
      std::lower_bound(observations.begin(), observations.end(), keyframe,
                       [](const PointObservation& o, KeyframeId k) { return o.keyframe < k; });
  if (at != observations.end() && at->keyframe == keyframe) return false;
  slot = point;
  for (const PointObservation& other : observations)
    AddSharedPoint(keyframe, other.keyframe, 1);
  observations.insert(at, {keyframe, keypoint});
  return true;
}

void Map::RemoveObservation(PointId point, KeyframeId keyframe) {
  MapPoint& landmark = EditPoint(point);
  auto& observations = landmark.observations;
  const auto at = std::find_if(observations.begin(), observations.end(),
                               [&](const PointObservation& o) { return o.keyframe == keyframe; });
  CSLAM_CHECK(at != observations.end(), "point {} is not seen by keyframe {}", point.value(),
              keyframe.value());
  EditKeyframe(keyframe).points[static_cast<std::size_t>(at->keypoint)] = PointId();
  observations.erase(at);
  for (const PointObservation& other : observations)
    AddSharedPoint(keyframe, other.keyframe, -1);
  if (observations.empty()) {
    ErasePoint(point);
  } else if (landmark.reference == keyframe) {
    landmark.reference = observations.front().keyframe;
  }
}

void Map::ErasePoint(PointId point) {
  MapPoint& landmark = EditPoint(point);
  auto& observations = landmark.observations;
  while (!observations.empty()) {
    const PointObservation last = observations.back();
    observations.pop_back();
    EditKeyframe(last.keyframe).points[static_cast<std::size_t>(last.keypoint)] = PointId();
    for (const PointObservation& other : observations) {
      AddSharedPoint(last.keyframe, other.keyframe, -1);
    }
  }
  landmark.state = PointState::kErased;
  --num_points_;
}

void Map::FusePoints(PointId keep, PointId drop) {
  if (keep == drop) return;
  CSLAM_CHECK(FindPoint(keep) != nullptr);
  const std::vector<PointObservation> moved = EditPoint(drop).observations;
  const int expected = FindPoint(drop)->times_expected;
  const int found = FindPoint(drop)->times_found;
  ErasePoint(drop);
  MapPoint& dropped = points_.Edit(drop.index());
  dropped.state = PointState::kFused;
  dropped.replaced_by = keep;
  if (!FindPoint(keep)->object.valid() && FindObject(dropped.object) != nullptr) {
    AssignPoint(keep, dropped.object);
  }
  for (const PointObservation& o : moved)
    AddObservation(keep, o.keyframe, o.keypoint);
  AddSightings(keep, expected, found);
  RefreshAppearance(keep);
}

void Map::SetPose(KeyframeId keyframe, const Se3& T_world_camera) {
  CSLAM_CHECK(T_world_camera.IsFinite(), "pose of keyframe {}", keyframe.value());
  EditKeyframe(keyframe).T_world_camera = T_world_camera;
}

void Map::SetPosition(PointId point, const Eigen::Vector3d& p_world) {
  CSLAM_CHECK(p_world.allFinite(), "position of point {}", point.value());
  EditPoint(point).p_world = p_world;
}

void Map::SetParent(KeyframeId keyframe, KeyframeId parent) {
  CSLAM_CHECK(FindKeyframe(parent) != nullptr);
  EditKeyframe(keyframe).parent = parent;
}

void Map::MergeMaps(MapId target, MapId source, KeyframeId parent, KeyframeId child) {
  CSLAM_CHECK(target != source && EditKeyframe(parent).map == target &&
              EditKeyframe(child).map == source);
  KeyframeId turned = child;
  for (KeyframeId new_parent = parent; turned.valid();) {
    const KeyframeId old_parent = FindKeyframe(turned)->parent;
    EditKeyframe(turned).parent = new_parent;
    new_parent = std::exchange(turned, old_parent);
  }
  for (std::size_t i = 0; i < keyframes_.size(); ++i) {
    if (keyframes_[i].map == source) keyframes_.Edit(i).map = target;
  }
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (points_[i].map == source) points_.Edit(i).map = target;
  }
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    if (objects_[i].map == source) objects_.Edit(i).map = target;
  }
}

MapObject& Map::EditObject(ObjectId id) {
  CSLAM_CHECK(FindObject(id) != nullptr, "object {}", id.value());
  return objects_.Edit(id.index());
}

ObjectId Map::AddObject(MapObject object) {
  CSLAM_CHECK(object.IsAlive() && object.map.valid() && Resolve(object.reference).has_value());
  object.id = ObjectId(static_cast<std::uint32_t>(objects_.size()));
  const ObjectId id = object.id;
  objects_.PushBack(std::move(object));
  return id;
}

void Map::SetObject(MapObject object) {
  CSLAM_CHECK(object.IsAlive() && std::isfinite(object.log_odds) && object.centroid.allFinite());
  const bool was_active = FindObject(object.id) != nullptr && FindObject(object.id)->is_active;
  const bool is_active = object.is_active;
  const ObjectId id = object.id;
  EditObject(id) = std::move(object);
  if (was_active == is_active) return;
  for (const PointId point : PointsOfObject(id))
    EditPoint(point).is_held_back = !is_active;
}

void Map::MergeObjects(ObjectId keep, ObjectId drop) {
  CSLAM_CHECK(keep != drop && FindObject(keep) != nullptr);
  for (const PointId point : PointsOfObject(drop))
    AssignPoint(point, keep);
  MapObject& dropped = EditObject(drop);
  dropped.state = ObjectState::kMerged;
  dropped.merged_into = keep;
  dropped.is_active = false;
  dropped.surface.reset();
  dropped.history = {};
}

void Map::EraseObject(ObjectId object, PointsOfErased points) {
  for (const PointId point : PointsOfObject(object)) {
    if (points == PointsOfErased::kErase) {
      ErasePoint(point);
    } else {
      AssignPoint(point, ObjectId());
    }
  }
  MapObject& erased = EditObject(object);
  erased.state = ObjectState::kErased;
  erased.is_active = false;
  erased.surface.reset();
  erased.history = {};
}

void Map::AssignPoint(PointId point, ObjectId object) {
  const MapObject* owner = object.valid() ? FindObject(object) : nullptr;
  CSLAM_CHECK(!object.valid() || owner != nullptr, "object {}", object.value());
  MapPoint& landmark = EditPoint(point);
  landmark.object = object;
  landmark.is_held_back = owner != nullptr && !owner->is_active;
}

std::vector<PointId> Map::PointsOfObject(ObjectId object) const {
  std::vector<PointId> points;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (points_[i].IsActive() && points_[i].object == object) points.push_back(points_[i].id);
  }
  return points;
}

void Map::SetChanges(std::vector<MapChange> changes) {
  changes_ = std::make_shared<const std::vector<MapChange>>(std::move(changes));
}

void Map::AddSightings(PointId point, int expected, int found) {
  MapPoint& landmark = EditPoint(point);
  landmark.times_expected += expected;
  landmark.times_found += found;
}

const Keypoint& Map::KeypointOf(const PointObservation& o) const {
  return FindKeyframe(o.keyframe)->data->features.keypoints[static_cast<std::size_t>(o.keypoint)];
}

void Map::RefreshAppearance(PointId point) {
  MapPoint& landmark = EditPoint(point);
  if (landmark.observations.empty()) return;
  std::vector<Descriptor> descriptors;
  descriptors.reserve(landmark.observations.size());
  for (const PointObservation& o : landmark.observations) {
    const FrameFeatures& features = FindKeyframe(o.keyframe)->data->features;
    descriptors.push_back(features.descriptors[static_cast<std::size_t>(o.keypoint)]);
  }
  const std::size_t medoid = MedoidIndex(descriptors);
  landmark.descriptor = descriptors[medoid];
  landmark.angle_rad = KeypointOf(landmark.observations[medoid]).angle_rad;
  RefreshGeometry(point);
}

void Map::RefreshGeometry(PointId point) {
  MapPoint& landmark = EditPoint(point);
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const PointObservation& o : landmark.observations) {
    const Eigen::Vector3d& center = FindKeyframe(o.keyframe)->T_world_camera.translation;
    normal += (landmark.p_world - center).normalized();
  }
  landmark.normal = normal.normalized().cast<float>();

  const auto anchor =
      std::find_if(landmark.observations.begin(), landmark.observations.end(),
                   [&](const PointObservation& o) { return o.keyframe == landmark.reference; });
  if (anchor == landmark.observations.end()) return;
  const double distance =
      (landmark.p_world - FindKeyframe(anchor->keyframe)->T_world_camera.translation).norm();
  const double scale = level_scales_[static_cast<std::size_t>(KeypointOf(*anchor).octave)];
  landmark.max_distance_m = static_cast<float>(distance * scale);
  landmark.min_distance_m = static_cast<float>(distance * scale / level_scales_.back());
}

}  // namespace cslam
