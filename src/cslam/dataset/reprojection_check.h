// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/check_frames.h"
#include "cslam/io/truth_files.h"

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace cslam {

struct ReprojectionOptions {
  std::size_t num_anchors = 40;   // frames that are compared with others, evenly spread
  DepthTolerance tolerance = {};  // of the difference between two frames
  int window_px = 1;         // half the side of the square that must be flat; 2 for noisy depth
  double min_cosine = 0.25;  // surfaces seen flatter than this (75 degrees) are left out
};

// Differences of one or more pairs of frames: depth read in one against depth predicted from the
// other with the true poses.
struct ReprojectionFigures {
  std::size_t num_points = 0;  // compared; hidden ones not among them
  double median_m = 0.0;       // of |difference|
  double p95_m = 0.0;
  double p95_per_tolerance = 0.0;  // of |difference| / tolerance: at most 1 if the bar is met
  double median_relative = 0.0;    // of |difference| / depth
  // Points hidden by something nearer in the other frame: nothing wrong in itself.
  double hidden_share = 0.0;
  // Points where the other frame looks through a surface that stands there: never happens if
  // poses and depth are true and nothing moves.
  double pierced_share = 0.0;
};

struct FramePair {
  std::size_t a = 0;
  std::size_t b = 0;
};

struct PairFigures {
  FramePair pair;
  ReprojectionFigures figures;
};

struct ReprojectionResult {
  std::vector<PairFigures> pairs;  // those that overlap
  ReprojectionFigures all;
};

// Pairs of frames that should see much of the same: for each anchor one a few frames later and,
// where the camera comes back to a view, one at least two seconds away.
std::vector<FramePair> ChoosePairs(const CheckFrames& frames, std::size_t num_anchors);

// Back-projects flat, well-seen pixels of each frame of a pair, projects them into the other and
// compares with its depth, interpolated in inverse depth. objects: tells which instances did not
// move between two frames; without them only the room (instance 0) is compared, and everything if
// there are no instance images either. Deterministic; reads two images a frame.
ReprojectionResult CheckReprojection(const CheckFrames& frames, const TrueObjects* objects,
                                     const ReprojectionOptions& options);

}  // namespace cslam
