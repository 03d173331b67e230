// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map_view.h"
#include "cslam/messages/loop_messages.h"
#include "cslam/objects/object_tracker.h"
#include "cslam/util/stopwatch.h"
#include "cslam/vision/rgbd_frame.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

// Everything that crosses a stage boundary. All of it is immutable once sent.
namespace cslam {

enum class TrackingState : std::uint8_t {
  kInitialising,  // no map yet: waiting for a frame with enough depth
  kTracking,      // the pose is measured
  kRecentlyLost,  // not found for a moment; the same map is still searched
  kLost,          // given up: the next good frame starts a new map
};
const char* ToString(TrackingState state);

// What becomes of the frames.
enum class TrackingMode : std::uint8_t {
  kMapping,       // poses, and the map grows
  kLocaliseOnly,  // poses in the map as it is: no new keyframes, nothing changes in it
};

// Why a keyframe was or was not proposed.
enum class KeyframeReason : std::uint8_t {
  kNotNeeded,
  kNotTracking,
  kLocaliseOnly,  // asked for nothing but the pose
  kFewInliers,    // too few inliers to trust the frame
  kMapperBusy,    // one would be useful, but enough proposals are in flight
  kStartsMap,
  kTooLongAgo,        // the last keyframe is max_interval frames back
  kReferenceLost,     // the view has moved away from the reference keyframe
  kNearPointsNeeded,  // few near points are tracked and many could be made
  kObjectChanged,     // what was seen of an object is about to change the belief in it
};
const char* ToString(KeyframeReason reason);
inline bool IsProposal(KeyframeReason reason) {
  return reason >= KeyframeReason::kStartsMap;
}

// How often the tracker expected a point in view and how often it found it.
struct PointSightings {
  PointId point;
  std::int32_t expected = 0;
  std::int32_t found = 0;
};

// What frames since the previous proposal say about one object of the map.
struct ObjectEvidence {
  ObjectId object;
  double log_ratio = 0.0;        // sum over views of log(p(Y|H=1) / p(Y|H=0))
  std::int32_t num_seen = 0;     // views in which it was detected at its place
  std::int32_t num_missed = 0;   // it stood in plain view and was not
  std::int32_t num_through = 0;  // its place was looked through
  std::optional<Stamp> first_through;
  std::optional<Stamp> last_seen;
};

// What a keyframe's frame shows of objects: sightings, and the depth they were seen in.
struct KeyframeObjects {
  DepthView view;
  std::vector<ObjectSighting> sightings;
  std::vector<ObjectEvidence> evidence;
};

// tracker -> mapper. The tracker hands out keyframe ids: it alone proposes.
struct KeyframeProposal {
  KeyframeId id;
  MapId map;
  KeyframeReason reason = KeyframeReason::kNotNeeded;
  std::shared_ptr<const KeyframeData> data;
  KeyframeId reference;                   // invalid when the proposal starts a new map
  Se3 T_reference_camera;                 // relative to reference; to the world for a new map
  std::vector<PointId> matches;           // one per keypoint; invalid = none. Stale ids are normal
  std::vector<PointSightings> sightings;  // since the previous proposal
  KeyframeObjects objects;
};

// mapper -> everyone: one revision of the map. The newest wins.
struct MapSnapshot {
  std::uint64_t revision = 0;
  std::uint32_t proposals_applied = 0;  // inserted or refused, since the start or the last reset
  MapView map;
};

// What one step of a stage took.
struct StageTime {
  const char* stage = "";  // a string literal
  double ms = 0.0;         // by the clock on the wall
  double cpu_ms = 0.0;     // of its thread's own time, whatever else the machine was doing
};

// Notes the time since the last lap as that of the named step, and starts the next lap.
void AddLap(std::vector<StageTime>& times, const char* stage, Stopwatch& watch);

// A keypoint as pictures show it.
struct LabelledKeypoint {
  Eigen::Vector2f raw_px;
  KeypointLabel label = KeypointLabel::kStatic;
};

// tracker -> sinks: one per input frame.
struct TrackingResult {
  FrameId frame;
  Stamp stamp;
  TrackingState state = TrackingState::kInitialising;
  std::string reason;  // why the state is what it is: "287 inliers", "11 inliers < 30", ...
  MapId map;
  std::optional<Se3> T_world_camera;  // as known now; set while tracking only
  KeyframeId reference;               // the pose is stored relative to this keyframe ...
  Se3 T_reference_camera;             // ... and follows its corrections
  int num_keypoints = 0;              // extracted
  int num_dynamic_keypoints = 0;      // of those, left out for what they lie on
  int num_map_matches = 0;            // map points matched before the final optimisation
  int num_inliers = 0;                // map points the final pose agrees with
  KeyframeReason keyframe_reason = KeyframeReason::kNotNeeded;
  std::uint64_t map_revision = 0;           // of the snapshot used
  std::vector<TrackedObject> objects;       // in the frame, by track
  std::vector<LabelledKeypoint> keypoints;  // all extracted, if asked for (report_keypoints)
  std::vector<StageTime> times;
};

// mapper -> sinks: what one step of the mapper did.
struct MapUpdate {
  // Continued: a map of an earlier run is there. Refused: the keyframe's map is gone.
  enum class Step : std::uint8_t { kInserted, kRefined, kRefused, kCorrected, kContinued };
  Step step = Step::kInserted;
  KeyframeId keyframe;
  std::shared_ptr<const MapSnapshot> snapshot;
  int points_created = 0;
  int points_fused = 0;
  int points_culled = 0;
  int keyframes_culled = 0;
  int objects_found = 0;    // new ones
  int objects_changed = 0;  // activated, gone, merged or back
  int ba_iterations = 0;
  bool ba_was_stopped = false;
  std::optional<CorrectionReport> correction;  // of a loop, a merge or a full bundle adjustment
  std::vector<StageTime> times;
};

}  // namespace cslam
