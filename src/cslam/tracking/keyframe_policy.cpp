// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/tracking/keyframe_policy.h"

namespace cslam {
namespace {

// Why a keyframe would be useful, whatever the mapper is doing.
KeyframeReason Need(const KeyframePolicyInput& in, const KeyframePolicyOptions& options) {
  if (in.near_tracked < options.near_tracked_low &&
      in.near_creatable > options.near_creatable_high) {
    return KeyframeReason::kNearPointsNeeded;
  }
  const double ratio =
      in.num_map_keyframes < 2 ? options.reference_ratio_first : options.reference_ratio;
  if (in.num_inliers < ratio * in.reference_points) return KeyframeReason::kReferenceLost;
  if (in.frames_since_keyframe >= options.max_interval_frames) return KeyframeReason::kTooLongAgo;
  return KeyframeReason::kNotNeeded;
}

}  // namespace

KeyframeReason ChooseKeyframe(const KeyframePolicyInput& in, const KeyframePolicyOptions& options) {
  if (in.state != TrackingState::kTracking) return KeyframeReason::kNotTracking;
  if (in.num_inliers < options.min_inliers) return KeyframeReason::kFewInliers;
  const KeyframeReason need = Need(in, options);
  if (!IsProposal(need)) return need;
  if (in.proposals_in_flight >= options.max_in_flight) return KeyframeReason::kMapperBusy;
  return need;
}

}  // namespace cslam
