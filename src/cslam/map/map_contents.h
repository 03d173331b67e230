// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/keyframe.h"
#include "cslam/map/loop_edge.h"
#include "cslam/map/map_object.h"
#include "cslam/map/map_point.h"

#include <vector>

namespace cslam {

// Everything a Map holds, slot by slot: index = id, culled keyframes and erased points included.
// Observations and covisibility are not asked for: Keyframe::points tells them.
struct MapContents {
  std::vector<double> level_scales;
  std::vector<Keyframe> keyframes;
  std::vector<MapPoint> points;
  std::vector<MapObject> objects;
  std::vector<MapChange> changes;
  std::vector<LoopEdge> loops;
  std::vector<KeyframeId> sessions;  // the first keyframe id of each; empty: all is of one
};

}  // namespace cslam
