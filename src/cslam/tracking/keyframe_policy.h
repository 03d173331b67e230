// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/messages/messages.h"
#include "cslam/tracking/tracker_options.h"

namespace cslam {

// All that the choice of keyframes depends on.
struct KeyframePolicyInput {
  TrackingState state = TrackingState::kInitialising;
  int num_inliers = 0;        // map points the frame's pose agrees with
  int reference_points = 0;   // well-observed points of the reference keyframe
  int num_map_keyframes = 0;  // in the snapshot
  int frames_since_keyframe = 0;
  int near_tracked = 0;         // keypoints with near depth that are inliers
  int near_creatable = 0;       // keypoints with near depth and no inlier
  int proposals_in_flight = 0;  // sent and not yet applied
};

// A pure function: whether the frame should become a keyframe, and why.
KeyframeReason ChooseKeyframe(const KeyframePolicyInput& input,
                              const KeyframePolicyOptions& options);

}  // namespace cslam
