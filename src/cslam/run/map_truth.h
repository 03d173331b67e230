// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/alignment.h"
#include "cslam/geometry/trajectory.h"
#include "cslam/map/map_view.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cslam {

// The true pose at a time: interpolated, where the truth has no gap there.
std::optional<Se3> PoseAt(const Trajectory& truth, Stamp stamp);

// Holds poses in a map's world against ground truth, after aligning the keyframes of that map to
// the truth at their stamps.
class MapTruth {
 public:
  // of_keyframes: in the same world as of_frames; the same, if the map was made of that recording.
  MapTruth(const MapView& map, const Trajectory& of_keyframes, Trajectory of_frames);

  // Of a pose in the world of a map; nothing if the truth does not know it, or not where the map
  // lies.
  std::optional<PoseDifference> ErrorOf(MapId map, Stamp stamp, const Se3& T_world_camera) const;

  // One line for each map that could not be aligned.
  const std::vector<std::string>& problems() const { return problems_; }
  bool IsAligned() const { return !alignments_.empty(); }
  double KeyframeRmse() const;  // m, the largest of all maps

 private:
  Trajectory of_frames_;
  std::map<MapId, Alignment> alignments_;  // of each map's world (b) onto the truth's (a)
  std::vector<std::string> problems_;
};

}  // namespace cslam
