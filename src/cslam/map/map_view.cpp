// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/map/map_view.h"

#include <algorithm>

namespace cslam {

const Keyframe* MapView::FindKeyframe(KeyframeId id) const {
  if (id.index() >= keyframes_.size()) return nullptr;
  const Keyframe& keyframe = keyframes_[id.index()];
  return keyframe.IsAlive() ? &keyframe : nullptr;
}

const MapPoint* MapView::FindPoint(PointId id) const {
  if (id.index() >= points_.size()) return nullptr;
  const MapPoint& point = points_[id.index()];
  return point.IsActive() ? &point : nullptr;
}

const MapObject* MapView::FindObject(ObjectId id) const {
  if (id.index() >= objects_.size()) return nullptr;
  const MapObject& object = objects_[id.index()];
  return object.IsAlive() ? &object : nullptr;
}

std::vector<ObjectId> MapView::Objects() const {
  std::vector<ObjectId> ids;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    if (objects_[i].IsAlive()) ids.push_back(objects_[i].id);
  }
  return ids;
}

std::optional<ObjectId> MapView::Resolve(ObjectId id) const {
  while (id.index() < objects_.size()) {
    const MapObject& object = objects_[id.index()];
    if (object.IsAlive()) return id;
    if (object.state != ObjectState::kMerged) return std::nullopt;
    id = object.merged_into;
  }
  return std::nullopt;
}

Se3 MapView::T_world_object(const MapObject& object) const {
  return T_world_keyframe(object.reference).value_or(Se3());
}

Eigen::Vector3d MapView::CentroidOf(const MapObject& object) const {
  return T_world_object(object) * object.centroid;
}

const std::vector<MapChange>& MapView::changes() const {
  static const std::vector<MapChange> kNone;
  return changes_ ? *changes_ : kNone;
}

std::optional<PointId> MapView::Resolve(PointId id) const {
  while (id.index() < points_.size()) {
    const MapPoint& point = points_[id.index()];
    if (point.IsActive()) return id;
    if (point.state != PointState::kFused) return std::nullopt;
    id = point.replaced_by;
  }
  return std::nullopt;
}

std::optional<AnchoredPose> MapView::Resolve(KeyframeId id) const {
  Se3 T_current_self;
  while (id.index() < keyframes_.size()) {
    const Keyframe& keyframe = keyframes_[id.index()];
    if (keyframe.IsAlive()) return AnchoredPose{id, T_current_self};
    if (!keyframe.forward_to.valid()) return std::nullopt;
    T_current_self = keyframe.T_forward_self * T_current_self;
    id = keyframe.forward_to;
  }
  return std::nullopt;
}

std::optional<Se3> MapView::T_world_keyframe(KeyframeId id) const {
  const auto anchored = Resolve(id);
  if (!anchored) return std::nullopt;
  return keyframes_[anchored->keyframe.index()].T_world_camera * anchored->T_keyframe_self;
}

MapId MapView::NextMapId() const {
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < keyframes_.size(); ++i) {
    if (keyframes_[i].map.valid()) next = std::max(next, keyframes_[i].map.value() + 1);
  }
  return MapId(next);
}

std::size_t MapView::SessionOf(KeyframeId id) const {
  const auto after = std::upper_bound(sessions_.begin(), sessions_.end(), id);
  return static_cast<std::size_t>(after - sessions_.begin()) - 1;
}

std::vector<KeyframeId> MapView::Keyframes() const {
  std::vector<KeyframeId> ids;
  ids.reserve(num_keyframes_);
  for (std::size_t i = 0; i < keyframes_.size(); ++i) {
    if (keyframes_[i].IsAlive()) ids.push_back(keyframes_[i].id);
  }
  return ids;
}

std::vector<CovisibleKeyframe> MapView::Neighbours(KeyframeId id, int min_shared,
                                                   std::size_t max_count) const {
  std::vector<CovisibleKeyframe> neighbours;
  const Keyframe* keyframe = FindKeyframe(id);
  if (keyframe == nullptr) return neighbours;
  for (const CovisibleKeyframe& covisible : keyframe->covisible) {
    if (covisible.shared_points >= min_shared) neighbours.push_back(covisible);
  }
  std::stable_sort(neighbours.begin(), neighbours.end(),
                   [](const CovisibleKeyframe& a, const CovisibleKeyframe& b) {
                     return a.shared_points > b.shared_points;
                   });
  if (neighbours.size() > max_count) neighbours.resize(max_count);
  return neighbours;
}

}  // namespace cslam
