// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/map/map.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace cslam {
namespace {

std::string CheckPoint(const MapView& map, const MapPoint& point) {
  const auto id = point.id.value();
  if (!point.p_world.allFinite() || !point.normal.allFinite()) {
    return fmt::format("point {} is not finite", id);
  }
  if (point.observations.empty()) return fmt::format("point {} has no observation", id);
  if (!std::is_sorted(point.observations.begin(), point.observations.end(),
                      [](const auto& a, const auto& b) { return a.keyframe < b.keyframe; })) {
    return fmt::format("observations of point {} are not sorted", id);
  }
  bool sees_reference = false;
  for (const PointObservation& o : point.observations) {
    const Keyframe* keyframe = map.FindKeyframe(o.keyframe);
    if (keyframe == nullptr) {
      return fmt::format("point {} is seen by keyframe {}, which is gone", id, o.keyframe.value());
    }
    if (keyframe->map != point.map) return fmt::format("point {} is seen from another map", id);
    const auto keypoint = static_cast<std::size_t>(o.keypoint);
    if (keypoint >= keyframe->points.size() || keyframe->points[keypoint] != point.id) {
      return fmt::format("keyframe {} does not see point {} back", o.keyframe.value(), id);
    }
    sees_reference |= o.keyframe == point.reference;
  }
  const MapObject* object = map.FindObject(point.object);
  if (point.object.valid() && object == nullptr) {
    return fmt::format("point {} is part of object {}, which is gone", id, point.object.value());
  }
  if (point.is_held_back != (object != nullptr && !object->is_active)) {
    return fmt::format("point {} is held back, or is not, against its object", id);
  }
  if (!sees_reference) return fmt::format("point {} is not seen by its reference", id);
  return {};
}

std::string CheckObservations(const MapView& map, const Keyframe& keyframe) {
  std::vector<std::int32_t> weights(map.num_keyframe_ids());
  for (std::size_t i = 0; i < keyframe.points.size(); ++i) {
    if (!keyframe.points[i].valid()) continue;
    const MapPoint* point = map.FindPoint(keyframe.points[i]);
    if (point == nullptr) {
      return fmt::format("keyframe {} sees point {}, which is gone", keyframe.id.value(),
                         keyframe.points[i].value());
    }
    const PointObservation expected{keyframe.id, static_cast<std::int32_t>(i)};
    if (std::find(point->observations.begin(), point->observations.end(), expected) ==
        point->observations.end()) {
      return fmt::format("point {} is not seen back by keyframe {}", point->id.value(),
                         keyframe.id.value());
    }
    for (const PointObservation& o : point->observations) {
      if (o.keyframe != keyframe.id) ++weights[o.keyframe.index()];
    }
  }
  std::vector<CovisibleKeyframe> recounted;
  recounted.reserve(keyframe.covisible.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] != 0) {
      recounted.push_back({KeyframeId(static_cast<std::uint32_t>(i)), weights[i]});
    }
  }
  if (recounted != keyframe.covisible) {
    return fmt::format("covisibility weights of keyframe {} are off", keyframe.id.value());
  }
  return {};
}

std::string CheckTree(const MapView& map, const Keyframe& keyframe) {
  KeyframeId id = keyframe.id;
  for (std::size_t steps = 0; steps <= map.num_keyframes(); ++steps) {
    const Keyframe* at = map.FindKeyframe(id);
    if (at == nullptr) return fmt::format("parent {} is gone", id.value());
    if (at->map != keyframe.map) return fmt::format("parent {} is of another map", id.value());
    if (!at->parent.valid()) return {};
    id = at->parent;
  }
  return fmt::format("keyframe {} is in a cycle of parents", keyframe.id.value());
}

std::string CheckKeyframe(const MapView& map, const Keyframe& keyframe) {
  if (!keyframe.T_world_camera.IsFinite()) {
    return fmt::format("pose of keyframe {} is not finite", keyframe.id.value());
  }
  if (keyframe.points.size() != keyframe.data->features.size()) {
    return fmt::format("keyframe {} has a wrong number of slots", keyframe.id.value());
  }
  if (auto violation = CheckObservations(map, keyframe); !violation.empty()) return violation;
  return CheckTree(map, keyframe);
}

std::string CheckObject(const MapView& map, const MapObject& object) {
  const auto id = object.id.value();
  if (!std::isfinite(object.log_odds) || !object.centroid.allFinite() ||
      !object.box.center.allFinite() || !object.box.size_m.allFinite()) {
    return fmt::format("object {} is not finite", id);
  }
  const auto anchored = map.Resolve(object.reference);
  if (!anchored || map.FindKeyframe(anchored->keyframe)->map != object.map) {
    return fmt::format("the reference of object {} is gone or in another map", id);
  }
  return {};
}

// Each map hangs together: exactly one keyframe without a parent.
std::string CheckRoots(const MapView& map) {
  std::map<MapId, int> roots;
  for (const KeyframeId id : map.Keyframes()) {
    const Keyframe& keyframe = *map.FindKeyframe(id);
    roots[keyframe.map] += keyframe.parent.valid() ? 0 : 1;
  }
  for (const auto& [id, count] : roots) {
    if (count != 1) return fmt::format("map {} has {} roots", id.value(), count);
  }
  return {};
}

}  // namespace

std::string Map::CheckInvariants() const {
  std::size_t num_points = 0;
  for (std::size_t i = 0; i < num_point_ids(); ++i) {
    const MapPoint* point = FindPoint(PointId(static_cast<std::uint32_t>(i)));
    if (point == nullptr) continue;
    ++num_points;
    if (auto violation = CheckPoint(*this, *point); !violation.empty()) return violation;
  }
  if (num_points != this->num_points()) return "the number of points is off";
  const std::vector<KeyframeId> keyframes = Keyframes();
  if (keyframes.size() != num_keyframes()) return "the number of keyframes is off";
  for (const KeyframeId id : keyframes) {
    if (auto violation = CheckKeyframe(*this, *FindKeyframe(id)); !violation.empty()) {
      return violation;
    }
  }
  for (const ObjectId id : Objects()) {
    if (auto violation = CheckObject(*this, *FindObject(id)); !violation.empty()) return violation;
  }
  return CheckRoots(*this);
}

}  // namespace cslam
