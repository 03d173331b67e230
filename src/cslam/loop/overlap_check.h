// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/loop/loop_fusion.h"
#include "cslam/loop/loop_options.h"

#include <string>

namespace cslam {

// Keyframes of one map that look where keyframes of the other look, after the correction, and
// whether they see the same there.
struct OverlapComparison {
  int num_agreeing = 0;
  int num_contradicting = 0;

  int num_compared() const { return num_agreeing + num_contradicting; }
};

// Two rooms that look alike agree wherever the loop was found; what lies beside them does not.
OverlapComparison CompareOverlap(const CorrectedView& view, MapId moving, MapId fixed,
                                 const PlaceSensor& sensor, const LoopFusionOptions& fusion,
                                 const OverlapCheckOptions& options);

// Why the two maps are not of one place; empty if nothing says so.
std::string WhyContradicted(const OverlapComparison& overlap, const OverlapCheckOptions& options);

}  // namespace cslam
