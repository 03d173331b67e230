// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/objects/depth_region.h"
#include "cslam/objects/keypoint_labels.h"
#include "cslam/objects/motion_regions.h"
#include "cslam/objects/object_filter.h"

#include <string>

namespace cslam {

class OptionList;

struct ObjectTrackerOptions {
  bool enabled = true;           // off: every keypoint counts as background
  bool label_movable = true;     // hold back the keypoints of things that may move
  bool hold_back_new = false;    // until they are known to rest, as in the paper
  bool filter_motion = true;     // trust movable things again once the filter finds them static
  double min_iou = 0.3;          // for a detection to be a known object
  double second_name_iou = 0.7;  // of two boxes: one thing called by two names
  double min_inside = 0.7;       // or for its region to be a piece of the detection's
  double bridge_s = 1.0;         // how long an undetected object is carried on
  double first_bridge_s = 0.2;   // ... if it was detected only once
  int max_history_frames = 30;   // how old a frame may be whose detections come late
  double left_behind_m = 0.3;    // a nameless thing seen to go so far is not trusted while in view
  // Furniture that nobody moves counts as room: what passes for it mostly is (rugs, shelves).
  std::string fixed = "bed dining_table toilet oven sink refrigerator";
  bool map_flat_on_walls = false;
  double max_flat_m = 0.8;        // larger flat things are floor
  double max_moving_share = 0.3;  // of the picture; a named thing that covers more is not moving
  double flat_score = 0.5;        // of the score of what does not stand out from what is around it
  double max_growth = 1.3;        // of a carried region's size, before it no longer grows
  RegionOptions region;
  LabelOptions labels;
  ObjectFilterOptions filter;
  MotionRegionOptions unknown;
};
void Describe(OptionList& list, ObjectTrackerOptions& options);

}  // namespace cslam
