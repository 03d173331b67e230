// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map.h"
#include "cslam/mapping/object_options.h"
#include "cslam/messages/messages.h"
#include "cslam/objects/object_classes.h"

#include <map>
#include <span>

// Which map points are an object's.

namespace cslam {

// Names the object of points that are nobody's yet, by the tracks of the keypoints that the
// keyframe sees them at.
void AssignPoints(Map& map, KeyframeId keyframe, std::span<const PointId> points,
                  const std::map<TrackId, ObjectId>& objects_of_tracks,
                  const ObjectClasses& classes);

// Gives things that are gone the points in and around their boxes that nobody had named, as far as
// the keyframe looks through them as well.
void SweepPlaces(Map& map, std::span<const ObjectId> gone, const KeyframeProposal& proposal,
                 const MapObjectOptions& options);

}  // namespace cslam
