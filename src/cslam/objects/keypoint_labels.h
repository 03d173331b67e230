// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/objects/depth_region.h"
#include "cslam/vision/box.h"
#include "cslam/vision/frame_features.h"

#include <span>
#include <string>
#include <vector>

namespace cslam {

class OptionList;

// How the keypoints of a detected thing are told from those of the background in its box.
enum class LabelRule {
  kBoxes,     // everything in the box is the thing's
  kBands,     // the paper's repopulation: what lies behind the thing's depth band is background
  kSurfaces,  // the thing is its connected surface in depth
};

struct LabelOptions {
  std::string rule = "surfaces";      // "boxes", "bands" or "surfaces"
  double person_threshold_m = 0.33;   // bands: behind the nearest depth by more is background
  double movable_threshold_m = 0.25;  // the same for other things
  double nearest_percentile = 0.05;   // bands: what counts as a box's nearest depth
  double max_depth_sigma_m = 1.5;     // bands: more spread speaks of an unlabelled occluder
  bool drop_occluded = true;          // bands: keypoints under an unlabelled occluder are out
  bool drop_without_depth = true;     // keypoints without depth at or in a thing are its own
  double surface_tolerance_m = 0.12;  // surfaces: a keypoint so much behind it is background
  int border_px = 2;  // surfaces: how far beyond its pixels a thing's keypoints may lie
};
void Describe(OptionList& list, LabelOptions& options);
LabelRule RuleOf(const LabelOptions& options);  // throws Error for an unknown name

// A thing in the picture, as labels need it.
struct LabelledThing {
  Box box;             // full-size px, undistorted
  DepthRegion region;  // its surface; empty: not known, its whole box counts
  int class_id = -1;   // COCO
  TrackId track;
  KeypointLabel label = KeypointLabel::kDynamic;  // what its keypoints become
};

// A label per keypoint (Algorithm 1 of the paper, made linear). Keypoints of one thing share one
// label. Where things overlap the nearer one has the keypoint, and a dynamic one before others.
std::vector<KeypointSemantics> LabelKeypoints(std::span<const Keypoint> keypoints,
                                              std::span<const LabelledThing> things,
                                              const DepthView& view, const LabelOptions& options);

// Depth readings of a box (m), those in the boxes of other things left out.
struct BoxDepths {
  int num_readings = 0;
  double nearest_m = 0.0;  // the given percentile
  double median_m = 0.0;
  double mean_m = 0.0;
  double farthest_m = 0.0;
  double sigma_m = 0.0;
  double centre_m = 0.0;  // median of the middle ninth; 0 without readings
};
BoxDepths MeasureBoxDepths(const DepthView& view, const Box& box, std::span<const Box> others,
                           double nearest_percentile);

}  // namespace cslam
