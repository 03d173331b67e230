// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/map/map_contents.h"

#include "cslam/map/map.h"
#include "cslam/util/check.h"

#include <algorithm>
#include <cmath>

namespace cslam {
namespace {

void CheckScales(const std::vector<double>& scales) {
  const auto is_usable = [](double scale) { return std::isfinite(scale) && scale > 0.0; };
  if (scales.empty() || !std::all_of(scales.begin(), scales.end(), is_usable)) {
    throw Error("the scales of the pyramid levels are wrong");
  }
}

void CheckPoint(const MapContents& contents, std::size_t index) {
  const MapPoint& point = contents.points[index];
  if (point.id.index() != index || point.state > PointState::kErased) {
    throw Error("point {} has a wrong id or state", index);
  }
  if (point.state == PointState::kFused && point.replaced_by.index() >= contents.points.size()) {
    throw Error("point {} continues as one that never was", index);
  }
  if (!point.IsActive()) return;
  if (!point.map.valid() || point.reference.index() >= contents.keyframes.size() ||
      point.created_by.index() >= contents.keyframes.size()) {
    throw Error("point {} belongs to nothing", index);
  }
  if (!std::isfinite(point.min_distance_m) || !std::isfinite(point.max_distance_m) ||
      !std::isfinite(point.angle_rad)) {
    throw Error("point {} is not finite", index);
  }
}

void CheckFeatures(const MapContents& contents, const Keyframe& keyframe) {
  const FrameFeatures& features = keyframe.data->features;
  const std::size_t size = features.size();
  if (features.descriptors.size() != size || features.semantics.size() != size ||
      keyframe.points.size() != size) {
    throw Error("keyframe {} has arrays of unequal length", keyframe.id.value());
  }
  for (const Keypoint& keypoint : features.keypoints) {
    if (keypoint.octave < 0 ||
        static_cast<std::size_t>(keypoint.octave) >= contents.level_scales.size()) {
      throw Error("keyframe {} has a keypoint of a level there is not", keyframe.id.value());
    }
  }
  for (const PointId point : keyframe.points) {
    if (!point.valid()) continue;
    if (point.index() >= contents.points.size() || !contents.points[point.index()].IsActive()) {
      throw Error("keyframe {} sees point {}, which is gone", keyframe.id.value(), point.value());
    }
  }
}

void CheckKeyframe(const MapContents& contents, std::size_t index) {
  const Keyframe& keyframe = contents.keyframes[index];
  if (keyframe.IsAlive()) {
    if (keyframe.id.index() != index || !keyframe.map.valid()) {
      throw Error("keyframe {} has a wrong id or no map", index);
    }
    CheckFeatures(contents, keyframe);
    return;
  }
  if (keyframe.id.valid() && keyframe.id.index() != index) {
    throw Error("keyframe {} has a wrong id", index);
  }
  if (!keyframe.points.empty() || !keyframe.T_forward_self.IsFinite()) {
    throw Error("keyframe {} is culled, but not cleanly", index);
  }
  if (keyframe.forward_to.valid() && keyframe.forward_to.index() >= contents.keyframes.size()) {
    throw Error("keyframe {} continues as one that never was", index);
  }
}

void CheckLoops(const MapContents& contents) {
  for (const LoopEdge& loop : contents.loops) {
    if (loop.match.index() >= contents.keyframes.size() ||
        loop.query.index() >= contents.keyframes.size() || !loop.T_match_query.IsFinite()) {
      throw Error("a loop joins keyframes that never were");
    }
  }
}

void CheckSessions(const MapContents& contents) {
  const std::vector<KeyframeId>& sessions = contents.sessions;
  if (sessions.empty()) return;
  if (sessions.front() != KeyframeId(0) || !std::is_sorted(sessions.begin(), sessions.end()) ||
      !sessions.back().valid() || sessions.back().index() > contents.keyframes.size()) {
    throw Error("its sessions are not in order");
  }
}

void CheckObject(const MapContents& contents, std::size_t index) {
  const MapObject& object = contents.objects[index];
  if (object.id.index() != index || object.state > ObjectState::kErased) {
    throw Error("object {} has a wrong id or state", index);
  }
  if (object.state == ObjectState::kMerged &&
      object.merged_into.index() >= contents.objects.size()) {
    throw Error("object {} continues as one that never was", index);
  }
  if (!object.IsAlive()) return;
  if (!object.first_keyframe.valid() || !object.arrived_keyframe.valid() ||
      !object.last_keyframe.valid()) {
    throw Error("nobody ever saw object {}", index);
  }
  if (!object.map.valid() || object.reference.index() >= contents.keyframes.size()) {
    throw Error("object {} belongs to nothing", index);
  }
}

void CheckChange(const MapContents& contents, const MapChange& change) {
  const auto is_known = [&](ObjectId id) { return id.index() < contents.objects.size(); };
  if (!is_known(change.object) || (change.new_object.valid() && !is_known(change.new_object)) ||
      change.kind > MapChangeKind::kReplaced) {
    throw Error("a change is of an object that never was");
  }
}

// Whether following next(index) from somewhere never leaves [0, size).
template <typename Next>
bool HasCycle(std::size_t size, Next&& next) {
  constexpr std::size_t kUnseen = static_cast<std::size_t>(-1);
  std::vector<std::size_t> seen_from(size, kUnseen);
  for (std::size_t start = 0; start < size; ++start) {
    std::size_t at = start;
    while (at < size && seen_from[at] == kUnseen) {
      seen_from[at] = start;
      at = next(at);
    }
    if (at < size && seen_from[at] == start) return true;
  }
  return false;
}

void CheckForwards(const MapContents& contents) {
  const auto next_point = [&](std::size_t i) {
    const MapPoint& point = contents.points[i];
    return point.state == PointState::kFused ? point.replaced_by.index() : PointId().index();
  };
  if (HasCycle(contents.points.size(), next_point)) throw Error("points are fused in a circle");
  const auto next_keyframe = [&](std::size_t i) {
    const Keyframe& keyframe = contents.keyframes[i];
    return keyframe.IsAlive() ? KeyframeId().index() : keyframe.forward_to.index();
  };
  if (HasCycle(contents.keyframes.size(), next_keyframe)) {
    throw Error("keyframes are forwarded in a circle");
  }
  const auto next_object = [&](std::size_t i) {
    const MapObject& object = contents.objects[i];
    return object.state == ObjectState::kMerged ? object.merged_into.index() : ObjectId().index();
  };
  if (HasCycle(contents.objects.size(), next_object)) throw Error("objects merge in a circle");
}

// In order of the keyframes, so they come out sorted.
void RestoreObservations(MapContents& contents) {
  for (MapPoint& point : contents.points)
    point.observations.clear();
  for (const Keyframe& keyframe : contents.keyframes) {
    for (std::size_t i = 0; i < keyframe.points.size(); ++i) {
      if (!keyframe.points[i].valid()) continue;
      auto& observations = contents.points[keyframe.points[i].index()].observations;
      if (!observations.empty() && observations.back().keyframe == keyframe.id) {
        throw Error("keyframe {} sees point {} twice", keyframe.id.value(),
                    keyframe.points[i].value());
      }
      observations.push_back({keyframe.id, static_cast<std::int32_t>(i)});
    }
  }
}

void RestoreCovisibility(MapContents& contents) {
  std::vector<std::int32_t> shared(contents.keyframes.size());
  for (Keyframe& keyframe : contents.keyframes) {
    std::vector<KeyframeId> neighbours;
    for (const PointId point : keyframe.points) {
      if (!point.valid()) continue;
      for (const PointObservation& o : contents.points[point.index()].observations) {
        if (o.keyframe == keyframe.id) continue;
        if (shared[o.keyframe.index()]++ == 0) neighbours.push_back(o.keyframe);
      }
    }
    std::sort(neighbours.begin(), neighbours.end());
    keyframe.covisible.clear();
    keyframe.covisible.reserve(neighbours.size());
    for (const KeyframeId id : neighbours) {
      keyframe.covisible.push_back({id, shared[id.index()]});
      shared[id.index()] = 0;
    }
  }
}

}  // namespace

Map::Map(MapContents contents) {
  CheckScales(contents.level_scales);
  for (std::size_t i = 0; i < contents.points.size(); ++i)
    CheckPoint(contents, i);
  for (std::size_t i = 0; i < contents.keyframes.size(); ++i)
    CheckKeyframe(contents, i);
  for (std::size_t i = 0; i < contents.objects.size(); ++i)
    CheckObject(contents, i);
  for (const MapChange& change : contents.changes)
    CheckChange(contents, change);
  CheckForwards(contents);
  CheckLoops(contents);
  CheckSessions(contents);
  RestoreObservations(contents);
  RestoreCovisibility(contents);

  level_scales_ = std::move(contents.level_scales);
  loops_ = std::move(contents.loops);
  if (!contents.sessions.empty()) sessions_ = std::move(contents.sessions);
  for (Keyframe& keyframe : contents.keyframes) {
    num_keyframes_ += keyframe.IsAlive() ? 1 : 0;
    keyframes_.PushBack(std::move(keyframe));
  }
  for (MapPoint& point : contents.points) {
    num_points_ += point.IsActive() ? 1 : 0;
    points_.PushBack(std::move(point));
  }
  for (MapObject& object : contents.objects)
    objects_.PushBack(std::move(object));
  if (!contents.changes.empty()) SetChanges(std::move(contents.changes));
  if (const std::string violation = CheckInvariants(); !violation.empty()) {
    throw Error("{}", violation);
  }
}

}  // namespace cslam
