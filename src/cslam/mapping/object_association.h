// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map_view.h"
#include "cslam/mapping/object_options.h"
#include "cslam/objects/object_sighting.h"

#include <map>
#include <optional>
#include <span>
#include <vector>

namespace cslam {

// A sighting, measured: what long-term association compares.
struct PlacedSighting {
  const ObjectSighting* sighting = nullptr;
  DepthRegion region;                          // the sighting's, or a part of it
  std::vector<Eigen::Vector3f> points_camera;  // of its surface, m
  Eigen::Vector3d centroid_world = Eigen::Vector3d::Zero();
  double extent_m = 0.0;  // across the view
};

PlacedSighting Place(const ObjectSighting& sighting, const DepthRegion& region,
                     const DepthView& view, const Se3& T_world_camera);

// Sightings that may become objects of the map: mapped classes, enough surface, and no more of it
// than such a thing can have.
std::vector<PlacedSighting> PlaceSightings(std::span<const ObjectSighting> sightings,
                                           const DepthView& view, const Se3& T_world_camera,
                                           const ObjectClasses& classes,
                                           const MapObjectOptions& options);

// When each object was seen last, before the keyframe at hand.
using SeenBefore = std::map<ObjectId, Stamp>;
SeenBefore WhenSeen(const MapView& map, MapId map_id);

// Long-term association (Algorithm 3): the object of the map that each sighting shows; nullopt: a
// new one. Alike in class, and either on the same surface or within the class distance and not
// contradicted: the known object is not looked through, does not stand elsewhere in the picture,
// and both together are no larger than such a thing. Best first; two sightings that are one object
// must both lie on its surface. Objects that are gone come back only on their own surface, unless
// most of that is still looked through: then it is the trail of something that moved slowly.
std::vector<std::optional<ObjectId>> AssociateSightings(
    const MapView& map, MapId map_id, std::span<const PlacedSighting> sightings,
    const DepthView& view, const Se3& T_world_camera, const SeenBefore& seen_before,
    const ObjectClasses& classes, const MapObjectOptions& options);

// An object that is another one seen twice, if there is one: alike, and the smaller surface lies on
// the larger. Neither may be gone, nor may they differ in colour if one was only seen before the
// other.
std::optional<ObjectId> FindDouble(const MapView& map, const MapObject& object,
                                   const ObjectClasses& classes, const MapObjectOptions& options);

}  // namespace cslam
