// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/map/map.h"
#include "cslam/mapping/object_options.h"

#include <optional>
#include <vector>

namespace cslam {

// The map's list of changes, kept complete and free of contradictions while objects go and come.
// A removal and an arrival become one: `moved` if both are alike in class, size and colour,
// `replaced` if another thing stands there now.
class ChangeList {
 public:
  ChangeList(const Camera& camera, const MapObjectOptions& options, const ObjectClasses& classes);

  // The object's place was seen without it.
  void OnGone(Map& map, ObjectId object, Stamp now, int num_views, std::uint32_t session) const;

  // The same of a thing that nobody had named there: the object was it.
  void OnOriginFound(Map& map, ObjectId origin, ObjectId object, Stamp now, int num_views,
                     std::uint32_t session) const;

  // The object is believed in for the first time, or again after it was gone, or is known better
  // since. If its arrival is told already, only asks again whether it is what is missing elsewhere.
  void OnArrived(Map& map, ObjectId object, Stamp now, std::uint32_t session) const;

  // What was told to have come is known better by now: is it what is missing elsewhere?
  void OnSeenAgain(Map& map, ObjectId object, Stamp now) const;

  // Another thing stands where the object stood.
  void OnDisplaced(Map& map, ObjectId object, ObjectId by, Stamp now, std::uint32_t session) const;

  // Those of which is told that they have come, from wherever.
  std::vector<ObjectId> CameFromNowhere(const MapView& map) const;

  // Whether the two look alike beyond doubt, whatever they are called.
  bool LooksTheSame(const MapObject& a, const MapObject& b) const;

  // What is told of it is that it has gone, not what became of it ...
  bool IsToldGone(const MapView& map, ObjectId gone) const;
  // ... or nothing.
  bool MayTurnUp(const MapView& map, ObjectId gone) const;

  // Whether the object may have been the origin, a thing that has gone.
  bool MayComeFrom(const MapObject& object, const MapObject& origin) const;

  // The object never was: it did not come, nor is it what anything turned into.
  void OnMistake(Map& map, ObjectId object) const;

  // drop turned out to be keep.
  void OnMerged(Map& map, ObjectId keep, ObjectId drop) const;

 private:
  bool LooksLike(const MapObject& a, const MapObject& b) const;
  bool WentBefore(const MapObject& old_object, const MapObject& new_object) const;
  bool StandsAt(const MapView& map, const MapObject& a, const MapObject& b) const;
  // Two halves that go together, and what one of them was joined with before.
  struct Pairing {
    MapChange joined;
    std::optional<MapChange> left_over;
    int rank = 0;  // the higher the better
  };
  std::optional<Pairing> PairUp(const MapView& map, const MapChange& change,
                                const MapChange& told) const;
  MapChange GoneOf(const MapView& map, ObjectId id, Stamp now, int num_views,
                   std::uint32_t session) const;
  void AddJoined(Map& map, const MapChange& change, ObjectId preferred = {}) const;
  void RejoinAdded(Map& map, MapChange added, Stamp now) const;
  bool TakeBackDisplacement(Map& map, ObjectId id, Stamp now) const;
  bool Join(const MapView& map, MapChange& change, const MapChange& other) const;

  const Camera camera_;
  const MapObjectOptions options_;
  const ObjectClasses& classes_;
};

}  // namespace cslam
