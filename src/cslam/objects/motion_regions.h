// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/objects/depth_region.h"
#include "cslam/objects/object_filter.h"

#include <span>
#include <vector>

namespace cslam {

class OptionList;

struct MotionRegionOptions {
  bool enabled = true;
  double reference_age_s = 0.35;    // how far back the compared views lie, the older one
  double margin_m = 0.05;           // free space must have been seen so far behind a surface ...
  double margin_per_m2 = 0.02;      // ... plus this times the depth squared
  double min_area_share = 0.002;    // of the picture, that has to have moved
  double max_area_share = 0.6;      // more than this is a wrong pose, not a mover
  double reach_m = 0.5;             // extent in depth of a thing that moves
  double growth_px = 48.0;          // how far a region may grow from what was seen to move
  double timing_s = 0.015;          // how far apart colour, depth and the rows of both may be taken
  double max_turn_rate_dps = 35.0;  // faster frames are blurred and their poses late
  int min_inliers = 60;             // of the pose it is judged by
};
void Describe(OptionList& list, MotionRegionOptions& options);

// An earlier view of the room.
struct EarlierView {
  const DepthView* view = nullptr;
  Se3 T_earlier_now;
  double age_s = 0.0;
};

// Whether the surface of region stands where the earlier view saw a surface too (it rests), or
// where that view looked through (it moves). kNotKnown where too little of it was in that view.
SurfaceMotion JudgeSurface(const DepthView& now, const DepthRegion& region,
                           const EarlierView& earlier, const MotionRegionOptions& options);

// Surfaces that stand where all the earlier views looked through: whatever they are, they have
// moved. What one of them did not see (hidden, out of the picture, no reading) is never judged.
// known (thumbnail mask, may be empty): pixels that need not be found again.
std::vector<DepthRegion> FindMovedRegions(const DepthView& now,
                                          std::span<const EarlierView> earlier,
                                          const cv::Mat& known, const MotionRegionOptions& options);

}  // namespace cslam
