// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map.h"
#include "cslam/mapping/object_association.h"
#include "cslam/mapping/past_place.h"
#include "cslam/messages/messages.h"

namespace cslam {

// What sightings make of an object: surface, colours, class, centroid and box.
class ObjectGrowth {
 public:
  ObjectGrowth(const MapObjectOptions& options, const ObjectClasses& classes);

  // A candidate without surface yet. The keyframe is the map's.
  MapObject Begin(const Map& map, MapId map_id, const KeyframeProposal& proposal,
                  const PlacedSighting& sighting) const;

  // The object with one more sighting. up_world: unit vector.
  MapObject WithSighting(const Map& map, MapObject object, const KeyframeProposal& proposal,
                         const PlacedSighting& sighting, const Eigen::Vector3d& up_world) const;

  // The object as it stood at an earlier place, which it has left; without votes, for nobody
  // called it anything there.
  MapObject AtPastPlace(const Map& map, const MapObject& object, const PastPlace& place,
                        const Eigen::Vector3d& up_world) const;

  // The object with centroid and box of its surface (or, as the paper has it, of its points).
  MapObject Measured(const Map& map, MapObject object, const Eigen::Vector3d& up_world) const;

 private:
  const MapObjectOptions options_;
  const ObjectClasses& classes_;
  const ExtentSource extent_source_;
};

}  // namespace cslam
