// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/map/map.h"
#include "cslam/objects/expected_view.h"

#include <cstdint>

namespace cslam {

// What keyframes saw, before an object was first seen, at the place where it stands.
struct ViewsBefore {
  int num_through = 0;               // it was empty
  int num_standing = 0;              // something was there, if only nobody named it
  bool is_between_sessions = false;  // all of those that looked through are of earlier sessions
};
ViewsBefore LookBack(const MapView& map, const MapObject& object, const Camera& camera,
                     std::uint32_t session, const ExpectedViewOptions& options);

}  // namespace cslam
