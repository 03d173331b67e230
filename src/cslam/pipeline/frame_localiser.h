// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"
#include "cslam/loop/place_stage.h"
#include "cslam/pipeline/slam_options.h"
#include "cslam/semantics/detector.h"
#include "cslam/tracking/frame_observer.h"

#include <memory>
#include <optional>
#include <string>

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

}  // namespace cslam
