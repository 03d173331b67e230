// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/loop/loop_options.h"
#include "cslam/map/map_view.h"
#include "cslam/messages/loop_messages.h"

#include <span>
#include <vector>

namespace cslam {

// How the keyframes of one map have to move, by id, for a loop to close: a pose graph over the
// spanning tree, strong covisibility and earlier loops, all of them as they are now, and the new
// loop as it was measured. The map's first keyframe holds still. The loop's keyframes are alive.
std::vector<KeyframeMove> SpreadLoop(const MapView& map, const LoopEdge& loop,
                                     std::span<const LoopEdge> earlier,
                                     const EssentialGraphOptions& options);

// All keyframes of a map move as one.
std::vector<KeyframeMove> MoveRigidly(const MapView& map, MapId id, const Se3& T_new_old);

}  // namespace cslam
