// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/keyframe.h"
#include "cslam/messages/place_hint.h"
#include "cslam/tracking/frame_matches.h"
#include "cslam/tracking/local_map.h"
#include "cslam/tracking/pose_history.h"
#include "cslam/tracking/tracker_options.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace cslam {

// The last tracked frame, as the next one is compared with it.
struct LastFrame {
  std::shared_ptr<const KeyframeData> data;  // null: there is none
  std::vector<PointId> points;               // what its keypoints are of; invalid: no map point
};

// A pose that all of the map around it agrees with, and what the search came across.
struct LocalMapPose {
  PoseEstimate estimate;
  KeyframeId reference;                 // shares most points with the frame
  std::vector<ExpectedPoint> expected;  // what else of the local map should be in view
  int num_map_matches = 0;              // with a say in the pose, before outliers were left out
};

// The pose of a frame in a map, found in one of three ways, then refined with all of the map that
// should be in view. Knows nothing of earlier calls. Whether there are inliers enough is for the
// caller to say.
class PoseSearch {
 public:
  PoseSearch(const Camera& camera, const TrackerOptions& options);

  // Looks for what the last frame saw near where the prediction puts it; last.data must be there.
  // Nothing if too little of it is found.
  std::optional<PoseEstimate> FromMotion(const FrameFeatures& features, const MapView& map,
                                         const LastFrame& last,
                                         const PosePrediction& prediction) const;

  // Without a prediction: looks for what resembles the points of a keyframe, given by its id or one
  // that it was merged into. Nothing if too little of it is found.
  std::optional<PoseEstimate> FromKeyframe(const FrameFeatures& features, const MapView& map,
                                           KeyframeId keyframe, const Se3& T_world_first) const;

  // Looks for the points of a recognised place; nothing if its keyframe is gone.
  std::optional<PoseEstimate> FromPlace(const FrameFeatures& features, const MapView& map,
                                        const PlaceHint& hint) const;

  // From a first pose and its matches: looks for the other points that should be in view.
  // last_reference: stands in where no keyframe shares points with the frame.
  LocalMapPose WithLocalMap(const FrameFeatures& features, const MapView& map, PoseEstimate first,
                            KeyframeId last_reference) const;

 private:
  struct LastSeen;  // what the last frame saw, and where it is looked for

  LastSeen PredictLast(const MapView& map, const LastFrame& last,
                       const PosePrediction& prediction) const;
  std::optional<Landmark> LastLandmark(const MapView& map, const LastFrame& last, std::size_t i,
                                       const Se3& T_world_last, bool use_held_back) const;
  std::optional<ProjectionQuery> QueryFor(const Keypoint& last,
                                          const Eigen::Vector3d& p_camera) const;
  std::vector<ExpectedPoint> Expect(const MapView& map, std::span<const PointId> points,
                                    const Se3& T_world_camera, const LocalMapOptions& options,
                                    HeldBack held_back) const;
  FrameMatches MatchExpected(const FrameFeatures& features, const MapView& map,
                             std::span<const ExpectedPoint> expected, FrameMatches known) const;
  FrameMatches SetHeldBackAside(const FrameFeatures& features, FrameMatches& matches) const;
  PoseEstimate Estimate(const FrameFeatures& features, FrameMatches matches,
                        const Se3& T_world_first, Provisional provisional) const;

  const Camera camera_;
  const ImageBounds bounds_;
  const TrackerOptions options_;
  const MeasurementModel model_;
};

}  // namespace cslam
