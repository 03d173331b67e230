// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/pipeline/run_result.h"

#include <map>

namespace cslam {
namespace {

bool IsTracked(const FrameRecord& frame) {
  return frame.state == TrackingState::kTracking;
}

}  // namespace

MapId MapOf(const RunResult& result, const FrameRecord& frame) {
  const MapView& map = result.snapshot->map;
  const auto anchored = map.Resolve(frame.reference);
  return anchored ? map.FindKeyframe(anchored->keyframe)->map : frame.map;
}

FrameRecord MakeRecord(const TrackingResult& result) {
  FrameRecord record;
  record.frame = result.frame;
  record.stamp = result.stamp;
  record.state = result.state;
  record.map = result.map;
  if (result.T_world_camera) record.T_world_camera = *result.T_world_camera;
  record.reference = result.reference;
  record.T_reference_camera = result.T_reference_camera;
  return record;
}

bool IsOfThisRun(const MapView& map, KeyframeId keyframe) {
  return map.SessionOf(keyframe) + 1 == map.sessions().size();
}

MapId LargestMap(const RunResult& result) {
  std::map<MapId, int> counts;
  for (const FrameRecord& frame : result.frames) {
    if (IsTracked(frame)) ++counts[MapOf(result, frame)];
  }
  MapId largest;
  for (const auto& [map, count] : counts) {
    if (!largest.valid() || count > counts[largest]) largest = map;
  }
  return largest;
}

Trajectory FinalTrajectory(const RunResult& result) {
  Trajectory trajectory;
  const MapId map = LargestMap(result);
  for (const FrameRecord& frame : result.frames) {
    if (!IsTracked(frame) || MapOf(result, frame) != map) continue;
    const auto T_world_reference = result.snapshot->map.T_world_keyframe(frame.reference);
    if (!T_world_reference) continue;
    trajectory.push_back({frame.stamp, *T_world_reference * frame.T_reference_camera});
  }
  return trajectory;
}

Trajectory LiveTrajectory(const RunResult& result) {
  Trajectory trajectory;
  const MapId map = LargestMap(result);
  for (const FrameRecord& frame : result.frames) {
    if (IsTracked(frame) && frame.map == map) {
      trajectory.push_back({frame.stamp, frame.T_world_camera});
    }
  }
  return trajectory;
}

Trajectory KeyframeTrajectory(const RunResult& result) {
  Trajectory trajectory;
  const MapId map = LargestMap(result);
  for (const KeyframeId id : result.snapshot->map.Keyframes()) {
    const Keyframe& keyframe = *result.snapshot->map.FindKeyframe(id);
    if (keyframe.map != map || !IsOfThisRun(result.snapshot->map, id)) continue;
    trajectory.push_back({keyframe.data->stamp, keyframe.T_world_camera});
  }
  return trajectory;
}

}  // namespace cslam
