// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/trajectory.h"
#include "cslam/messages/messages.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace cslam {

// What is left of a frame once it has been processed.
struct FrameRecord {
  FrameId frame;
  Stamp stamp;
  TrackingState state = TrackingState::kInitialising;
  MapId map;
  Se3 T_world_camera;    // as first published
  KeyframeId reference;  // the final pose is found through this keyframe
  Se3 T_reference_camera;
};

FrameRecord MakeRecord(const TrackingResult& result);

// The outcome of a run, or of a run so far.
struct RunResult {
  std::vector<FrameRecord> frames;  // every frame processed, tracked or not
  std::shared_ptr<const MapSnapshot> snapshot;
  std::uint64_t frames_dropped = 0;  // never processed: the tracker was busy (sensor rate)
};

// The map that a tracked frame's reference keyframe is in by now: maps merge.
MapId MapOf(const RunResult& result, const FrameRecord& frame);

// Whether this run made the keyframe, and not an earlier one whose map it went on in.
bool IsOfThisRun(const MapView& map, KeyframeId keyframe);

// The map in which most frames were tracked; invalid if none was.
MapId LargestMap(const RunResult& result);

// Final poses of the frames tracked in that map, resolved through their reference keyframes.
Trajectory FinalTrajectory(const RunResult& result);

// The same frames' poses as they were first published.
Trajectory LiveTrajectory(const RunResult& result);

// Final poses of those keyframes of that map that this run made.
Trajectory KeyframeTrajectory(const RunResult& result);

}  // namespace cslam
