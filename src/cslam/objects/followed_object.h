// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/objects/depth_region.h"
#include "cslam/objects/object_filter.h"
#include "cslam/objects/object_sighting.h"
#include "cslam/semantics/detection.h"
#include "cslam/util/stamp.h"

#include <optional>

namespace cslam {

// A thing as the tracker knows it from frame to frame.
struct FollowedObject {
  TrackId id;
  int class_id = -1;
  double score = 0.0;
  Box box;
  DepthRegion region;
  std::optional<ObjectFilter> filter;  // none before its first depth
  Stamp first_detected;
  Stamp detected;                  // the newest frame a detector saw it in
  Stamp filtered;                  // the newest frame its filter took in
  double reference_area_m2 = 0.0;  // of the region as detected
  bool is_detected_now = false;
  bool is_flat = false;  // see DepthRegion
  bool is_on_wall = false;
  std::optional<Eigen::Vector3d> found_at;  // world; of a nameless thing
  bool has_travelled = false;               // a nameless thing that was seen to go a long way
  bool is_person() const { return class_id == kPersonClass; }
};

}  // namespace cslam
