// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/messages/messages.h"

namespace cslam {

const char* ToString(TrackingState state) {
  switch (state) {
    case TrackingState::kInitialising:
      return "initialising";
    case TrackingState::kTracking:
      return "tracking";
    case TrackingState::kRecentlyLost:
      return "recently_lost";
    case TrackingState::kLost:
      return "lost";
  }
  return "unknown";
}

void AddLap(std::vector<StageTime>& times, const char* stage, Stopwatch& watch) {
  const LapTime lap = watch.Lap();
  times.push_back({.stage = stage, .ms = lap.wall_ms, .cpu_ms = lap.cpu_ms});
}

const char* ToString(KeyframeReason reason) {
  switch (reason) {
    case KeyframeReason::kNotNeeded:
      return "not_needed";
    case KeyframeReason::kNotTracking:
      return "not_tracking";
    case KeyframeReason::kLocaliseOnly:
      return "localise_only";
    case KeyframeReason::kFewInliers:
      return "few_inliers";
    case KeyframeReason::kMapperBusy:
      return "mapper_busy";
    case KeyframeReason::kStartsMap:
      return "starts_map";
    case KeyframeReason::kTooLongAgo:
      return "too_long_ago";
    case KeyframeReason::kReferenceLost:
      return "reference_lost";
    case KeyframeReason::kNearPointsNeeded:
      return "near_points_needed";
    case KeyframeReason::kObjectChanged:
      return "object_changed";
  }
  return "unknown";
}

}  // namespace cslam
