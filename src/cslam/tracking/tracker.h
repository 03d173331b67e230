// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/messages/messages.h"
#include "cslam/messages/place_hint.h"
#include "cslam/tracking/frame_observer.h"
#include "cslam/tracking/pose_history.h"
#include "cslam/tracking/pose_search.h"
#include "cslam/tracking/sighting_counter.h"
#include "cslam/tracking/tracker_options.h"

#include <memory>
#include <optional>

namespace cslam {

struct TrackerOutput {
  TrackingResult result;
  std::optional<KeyframeProposal> proposal;
  std::optional<LostFrame> lost;  // the frame, if its pose was not found in a map there is
};

// Estimates the camera pose of every frame against the newest map snapshot, and proposes
// keyframes. Synchronous and single-threaded; never touches the map itself.
//
// Poses are kept relative to a keyframe, so when a snapshot has moved that keyframe the tracker
// moves along and sees no jump.
class Tracker {
 public:
  Tracker(const Camera& camera, const TrackerOptions& options);

  // Frames in order of time. snapshot: the newest there is; null before the first. detections: the
  // newest there are, of this frame or an earlier one; null: none yet. hint: what is known of the
  // place of the last frame reported as lost; null: nothing.
  TrackerOutput Process(const RgbdFrame& frame, const std::shared_ptr<const MapSnapshot>& snapshot,
                        const Detections* detections = nullptr, const PlaceHint* hint = nullptr);

  // Forgets everything but the ids handed out: the next good frame starts a new map.
  void Reset();

  // The same, and goes on in a map of an earlier run: its place is searched before a new map may
  // start, and ids begin beyond its own.
  void Continue(const MapView& map);

  // For the frames to come.
  void SetMode(TrackingMode mode) { mode_ = mode; }

 private:
  struct CurrentFrame;  // what is being worked out for the frame at hand

  void Observe(const RgbdFrame& frame, const Detections* detections, CurrentFrame& current);
  void LeaveOutUnknown(CurrentFrame& current);
  void TrackFrame(CurrentFrame& current);
  bool FindFirstPose(CurrentFrame& current) const;
  bool Adopt(std::optional<PoseEstimate> found, CurrentFrame& current) const;
  void Relocalise(CurrentFrame& current, const PlaceHint& hint);
  void FollowMerges();
  void EnterMap(MapId map);
  void RefineWithLocalMap(CurrentFrame& current) const;
  void WatchObjects(const CurrentFrame& current, const Detections* detections);
  KeyframeObjects TakeObjects(const CurrentFrame& current);
  void CountSightings(const CurrentFrame& current);
  void FailToTrack(CurrentFrame& current, std::string reason);
  KeyframeReason DecideKeyframe(const CurrentFrame& current) const;
  void ForgetMap();
  bool MayStartMap(const CurrentFrame& current);
  void StartMap(CurrentFrame& current);
  KeyframeProposal Propose(CurrentFrame& current, KeyframeReason reason);
  void Remember(const CurrentFrame& current);
  TrackerOutput Report(CurrentFrame& current);

  const Camera camera_;
  const ImageBounds bounds_;
  const TrackerOptions options_;
  const PoseSearch search_;
  FrameObserver observer_;
  ObjectWatch watch_;

  std::shared_ptr<const MapSnapshot> snapshot_;
  TrackingMode mode_ = TrackingMode::kMapping;
  TrackingState state_ = TrackingState::kInitialising;
  bool searches_first_ = false;          // in the map that was there before the first frame
  std::optional<Stamp> searches_since_;  // the first frame's
  MapId map_;
  std::uint32_t next_map_ = 0;
  std::uint32_t next_keyframe_ = 0;
  std::uint32_t proposals_sent_ = 0;
  int frames_since_keyframe_ = 0;
  PoseHistory history_;  // poses that follow the map's corrections

  LastFrame last_;
  std::optional<Vector6> velocity_;  // tangent of T_previous_current per second
  SightingCounter sightings_;        // since the last proposal
};

}  // namespace cslam
