// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/messages/messages.h"
#include "cslam/tracking/frame_matches.h"
#include "cslam/tracking/local_map.h"

#include <span>
#include <vector>

namespace cslam {

// Counts in how many frames map points should have been seen, and in how many they were: the
// mapper drops points that are hardly ever found.
class SightingCounter {
 public:
  // One frame's. expected: those that should be in view; what was matched counts as well.
  // num_point_ids: of the map.
  void Count(std::span<const ExpectedPoint> expected, const FrameMatches& matches,
             std::size_t num_point_ids);

  // All counted since the last call, in the order of their first sighting.
  std::vector<PointSightings> Take();

 private:
  PointSightings& Entry(PointId id);

  std::vector<PointSightings> sightings_;  // by point id
  std::vector<PointId> sighted_;           // those with an entry
};

}  // namespace cslam
