// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map_object.h"
#include "cslam/util/id.h"
#include "cslam/util/stamp.h"

#include <Eigen/Core>

#include <vector>

namespace cslam {

// Where a thing stood before it came to where it stands now, though nobody named it there.
struct PastPlace {
  KeyframeId reference;                 // that saw most of it
  std::vector<Eigen::Vector3f> points;  // camera frame of reference, m
  ColourHistogram colours{};
  KeyframeId first_keyframe;  // of those that saw it
  KeyframeId last_keyframe;
  int num_views = 0;    // keyframes that saw it
  int num_through = 0;  // later ones that looked through its place
  Stamp first_through;
};

}  // namespace cslam
