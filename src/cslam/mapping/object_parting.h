// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/mapping/object_association.h"

namespace cslam {

// The sighting without what is a smaller thing of another kind that the map knows: the bear is no
// part of the chair it sits on, though the detector may miss it just now. known: the object that
// the sighting shows; nullptr: a new one. What would leave little of the sighting leaves it as it
// is: then it shows the smaller thing itself, by another name.
PlacedSighting PartFromOthers(const MapView& map, MapId map_id, const PlacedSighting& sighting,
                              const MapObject* known, const DepthView& view,
                              const Se3& T_world_camera, const ObjectClasses& classes,
                              const MapObjectOptions& options);

}  // namespace cslam
