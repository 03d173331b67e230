// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/alignment.h"
#include "cslam/geometry/trajectory.h"
#include "cslam/loop/place_stage.h"
#include "cslam/pipeline/slam_options.h"
#include "cslam/semantics/detector.h"
#include "cslam/tracking/frame_observer.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cslam {

// What became of one frame that was looked for on its own.
struct LocalisedFrame {
  FrameId frame;
  Stamp stamp;
  std::optional<Se3> T_world_camera;  // in the world of that map; nothing: not found
  MapId map;
  std::string reason;    // why it was found, or why not
  double find_ms = 0.0;  // CPU time of the search, features of the frame excluded
};

// Finds frames in a map, each from nothing but itself, just as SLAM does after a loss.
class FrameLocaliser {
 public:
  // detector: null for none. The camera must be that of the map.
  FrameLocaliser(std::shared_ptr<const MapSnapshot> map, const Camera& camera,
                 const SlamOptions& options, std::unique_ptr<Detector> detector);

  LocalisedFrame Find(const RgbdFrame& frame);

 private:
  const std::shared_ptr<const MapSnapshot> map_;
  const SlamOptions options_;
  const std::unique_ptr<Detector> detector_;
  FrameObserver observer_;
  PlaceStage places_;
};

// The true pose at a time: interpolated, where the truth has no gap there.
std::optional<Se3> PoseAt(const Trajectory& truth, Stamp stamp);

// Holds poses in a map's world against ground truth, after aligning the keyframes of that map to
// the truth at their stamps.
class MapTruth {
 public:
  MapTruth(const MapView& map, Trajectory truth);

  // Of a frame that was found; nothing if the truth does not know it, or not where its map lies.
  std::optional<PoseDifference> ErrorOf(const LocalisedFrame& frame) const;

  // One line for each map that could not be aligned.
  const std::vector<std::string>& problems() const { return problems_; }
  bool IsAligned() const { return !alignments_.empty(); }
  double KeyframeRmse() const;  // m, the largest of all maps

 private:
  Trajectory truth_;
  std::map<MapId, Alignment> alignments_;  // of each map's world (b) onto the truth's (a)
  std::vector<std::string> problems_;
};

}  // namespace cslam
