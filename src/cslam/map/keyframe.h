// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"
#include "cslam/util/id.h"
#include "cslam/util/stamp.h"
#include "cslam/vision/frame_features.h"

#include <opencv2/core/mat.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace cslam {

// What a keyframe measured. Never changes; shared between the map, snapshots and the tracker.
struct KeyframeData {
  FrameId frame;
  Stamp stamp;
  FrameFeatures features;
  cv::Mat depth_small_mm;  // about 160 x 120, CV_16UC1, millimetres, 0 = none or dynamic
  cv::Mat bgr_small;       // about 80 x 60, CV_8UC3, as recorded; empty without colours
};

// A neighbour in the covisibility graph.
struct CovisibleKeyframe {
  KeyframeId id;
  std::int32_t shared_points = 0;

  bool operator==(const CovisibleKeyframe&) const = default;
};

// A keyframe of the map: const payload plus a small mutable part that only Map changes.
struct Keyframe {
  KeyframeId id;
  MapId map;
  Se3 T_world_camera;
  KeyframeId parent;                         // spanning tree; invalid for a map's first keyframe
  std::shared_ptr<const KeyframeData> data;  // null once the keyframe has been culled
  std::vector<PointId> points;               // one per keypoint; invalid = none
  std::vector<CovisibleKeyframe> covisible;  // every keyframe that shares a point, sorted by id

  // Of a culled keyframe: it lives on as a pose relative to forward_to.
  KeyframeId forward_to;
  Se3 T_forward_self;

  bool IsAlive() const { return data != nullptr; }
};

}  // namespace cslam
