// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/objects/followed_object.h"
#include "cslam/objects/object_tracker_options.h"

#include <set>

namespace cslam {

// What a followed thing is good for: to be an object of the map, to hold the camera's position, or
// neither.
class ObjectUses {
 public:
  ObjectUses(const Camera& camera, const ObjectTrackerOptions& options);

  // Part of the room itself: neither an object of the map nor kept out of it.
  bool IsRoom(const FollowedObject& object) const;

  // Of its keypoints.
  KeypointLabel LabelOf(const FollowedObject& object) const;

 private:
  bool FillsThePicture(const FollowedObject& object) const;

  const double focal_px_;
  const ObjectTrackerOptions options_;
  const std::set<int> fixed_;  // classes
};

}  // namespace cslam
