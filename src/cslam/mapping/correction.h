// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map.h"
#include "cslam/messages/loop_messages.h"

namespace cslam {

// Closes a loop or merges two maps, in one step. Every keyframe's move is applied to its pose as it
// is by now, so what was refined since the snapshot survives; keyframes newer than the snapshot
// move with their parent in the spanning tree, points with their reference keyframe. Refused,
// without a change, when another correction came in between or the loop's keyframes are gone.
CorrectionReport ApplyCorrection(Map& map, const MapCorrection& correction);

// Replaces poses and positions that are as they were in the snapshot. Those changed since keep
// their change on top of the refinement, later ones are carried along as above.
CorrectionReport ApplyRefinement(Map& map, const PoseRefinement& refinement);

}  // namespace cslam
