// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/mapping/gone_surfaces.h"
#include "cslam/mapping/object_changes.h"
#include "cslam/mapping/object_growth.h"

#include <optional>

namespace cslam {

// Where things that came from nowhere had stood before: without a name, or under another one. What
// is found becomes an object that has gone, and the change list makes moves of the two.
class ObjectOrigins {
 public:
  // Keeps references to classes, growth and changes.
  ObjectOrigins(const Camera& camera, const MapObjectOptions& options, const ObjectClasses& classes,
                const ObjectGrowth& growth, const ChangeList& changes);

  // The keyframe is the newest, and its sightings are in the map. up_world: unit vector.
  void Update(Map& map, KeyframeId keyframe, const Eigen::Vector3d& up_world);

  void Reset() { gone_.Reset(); }

 private:
  bool MayHaveMovedUnseen(const MapView& map, const MapObject& object) const;
  std::optional<ObjectId> CalledOtherwise(const MapView& map, const MapObject& origin,
                                          const MapObject& object) const;
  void TellOrigin(Map& map, const MapObject& origin, const MapObject& object, int num_through,
                  KeyframeId keyframe) const;

  const MapObjectOptions options_;
  const ObjectClasses& classes_;
  const ObjectGrowth& growth_;
  const ChangeList& changes_;
  GoneSurfaces gone_;
};

}  // namespace cslam
