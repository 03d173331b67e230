// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/object_origins.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace cslam {

ObjectOrigins::ObjectOrigins(const Camera& camera, const MapObjectOptions& options,
                             const ObjectClasses& classes, const ObjectGrowth& growth,
                             const ChangeList& changes)
    : options_(options),
      classes_(classes),
      growth_(growth),
      changes_(changes),
      gone_(camera, options.view, options.past) {}

void ObjectOrigins::Update(Map& map, KeyframeId keyframe, const Eigen::Vector3d& up_world) {
  const bool has_news = gone_.LookThrough(map, keyframe);
  const MapId map_id = map.FindKeyframe(keyframe)->map;
  for (const ObjectId id : changes_.CameFromNowhere(map)) {
    if (!std::ranges::count(changes_.CameFromNowhere(map), id)) continue;  // by now it has moved
    const MapObject object = *map.FindObject(id);
    if (object.map != map_id || object.state != ObjectState::kPresent ||
        (!has_news && object.last_keyframe != keyframe) || MayHaveMovedUnseen(map, object)) {
      continue;
    }
    const auto place = gone_.FindPast(map, object, classes_, up_world);
    if (!place) continue;
    const MapObject origin = growth_.AtPastPlace(map, object, *place, up_world);
    if (changes_.MayComeFrom(object, origin))
      TellOrigin(map, origin, object, place->num_through, keyframe);
  }
}

// Whether a known thing like it, that nobody has seen since it came, may have been it.
bool ObjectOrigins::MayHaveMovedUnseen(const MapView& map, const MapObject& object) const {
  const std::vector<ObjectId> all = map.Objects();
  return std::any_of(all.begin(), all.end(), [&](ObjectId id) {
    const MapObject& other = *map.FindObject(id);
    return id != object.id && other.state == ObjectState::kPresent &&
           other.last_seen < object.first_seen && changes_.MayComeFrom(object, other);
  });
}

// What stood at the origin, as large and of the same colours, but under another name.
std::optional<ObjectId> ObjectOrigins::CalledOtherwise(const MapView& map, const MapObject& origin,
                                                       const MapObject& object) const {
  const Eigen::Vector3d place = map.CentroidOf(origin);
  for (const ObjectId id : map.Objects()) {
    const MapObject& other = *map.FindObject(id);
    if (other.map != origin.map || other.state == ObjectState::kCandidate ||
        classes_.AreAlike(other.class_id, object.class_id) ||
        (map.CentroidOf(other) - place).norm() > options_.past.same_place_m) {
      continue;
    }
    MapObject renamed = other;
    renamed.class_id = object.class_id;
    if (changes_.MayTurnUp(map, id) && changes_.LooksTheSame(object, other) &&
        changes_.MayComeFrom(object, renamed)) {
      return id;
    }
  }
  return std::nullopt;
}

void ObjectOrigins::TellOrigin(Map& map, const MapObject& origin, const MapObject& object,
                               int num_through, KeyframeId keyframe) const {
  const Stamp now = map.FindKeyframe(keyframe)->data->stamp;
  const auto session = static_cast<std::uint32_t>(map.SessionOf(keyframe));
  const auto known = CalledOtherwise(map, origin, object);
  if (!known) {
    changes_.OnOriginFound(map, map.AddObject(origin), object.id, now, num_through, session);
    return;
  }
  MapObject renamed = *map.FindObject(*known);
  const bool is_told = renamed.state == ObjectState::kAbsent && changes_.IsToldGone(map, *known);
  renamed.class_id = object.class_id;
  renamed.votes.clear();  // it was never called that
  renamed.state = ObjectState::kAbsent;
  renamed.is_active = false;
  renamed.log_odds = std::min(renamed.log_odds, LogOdds(options_.belief.absent_at));
  if (!renamed.absent_since) renamed.absent_since = origin.absent_since;
  map.SetObject(std::move(renamed));
  if (is_told) {
    changes_.OnSeenAgain(map, object.id, now);
  } else {
    changes_.OnOriginFound(map, *known, object.id, now, num_through, session);
  }
}

}  // namespace cslam
