// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"
#include "cslam/map/loop_edge.h"
#include "cslam/util/id.h"
#include "cslam/util/stamp.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// What passes between loop closing and the mapper, and what is told about it. Everything was worked
// out on a snapshot: the mapper applies it to the map as it is by then, and stale ids are normal.
namespace cslam {

// How a correction moves what hangs on one keyframe: p_new = T_new_old * p_old, both in the world.
struct KeyframeMove {
  KeyframeId keyframe;
  Se3 T_new_old;
};

// Two points that turned out to be one.
struct PointPair {
  PointId keep;
  PointId drop;
};

// A keypoint that turned out to show a point.
struct FoundPoint {
  PointId point;
  KeyframeId keyframe;
  std::int32_t keypoint = 0;
};

// loop -> mapper: a loop closes, or two maps become one.
struct MapCorrection {
  std::uint32_t epoch = 0;  // of the snapshot: MapView::correction_epoch()
  LoopEdge loop;
  MapId map;                        // whose keyframes move
  MapId merge_into;                 // another map that swallows it; invalid: a loop within map
  std::vector<KeyframeMove> moves;  // of the snapshot's keyframes of map, by id
  std::vector<PointPair> pairs;
  std::vector<FoundPoint> found;
};

// loop -> mapper: a full bundle adjustment of one map.
struct PoseRefinement {
  struct Pose {
    KeyframeId keyframe;
    Se3 T_world_camera_old;  // in the snapshot
    Se3 T_world_camera_new;
  };
  struct Position {
    PointId point;
    Eigen::Vector3d p_world_old;
    Eigen::Vector3d p_world_new;
  };
  struct Observation {
    PointId point;
    KeyframeId keyframe;
  };
  std::uint32_t epoch = 0;  // of the snapshot: MapView::correction_epoch()
  MapId map;
  std::vector<Pose> poses;            // by keyframe
  std::vector<Position> positions;    // by point
  std::vector<Observation> outliers;  // observations the solution disagrees with
  int iterations = 0;
};

// mapper -> sinks: what became of a correction or a refinement.
struct CorrectionReport {
  std::string refusal;  // why nothing was changed; empty: applied
  int keyframes_moved = 0;
  int keyframes_carried = 0;  // of those, newer than the snapshot or changed since
  int points_moved = 0;
  int points_fused = 0;
  int observations_added = 0;
  int observations_removed = 0;

  bool is_applied() const { return refusal.empty(); }
};

enum class LoopVerdict : std::uint8_t {
  kRefused,
  kPending,  // verified, but not yet by enough keyframes
  kClosed,   // a loop within one map
  kMerged,   // two maps became one
};
const char* ToString(LoopVerdict verdict);

// What speaks for a candidate, as far as it was looked at.
struct LoopEvidence {
  double score = 0.0;          // of the place index
  int num_matches = 0;         // descriptor matches
  int num_ransac_inliers = 0;  // of those, that agree on a pose
  int num_inliers = 0;         // the verified pose agrees with
  int num_expected = 0;        // points that should have been in view
  double inlier_spread = 0.0;  // share of the image's cells that hold one
  double median_error_px = 0.0;
  int num_confirmations = 0;        // keyframes that found the same, the first included
  double path_m = 0.0;              // travelled between the two sightings
  double drift_m = 0.0;             // by which the loop moves the newer one ...
  double drift_rad = 0.0;           // ... and turns it
  int depth_compared = 0;           // depth readings compared after the solve
  double depth_contradicted = 0.0;  // share of them in space another keyframe saw through
};

// One candidate of one keyframe, for loops.json: what people ask for when a loop goes wrong.
struct LoopRecord {
  KeyframeId query;
  KeyframeId match;
  Stamp query_stamp;
  Stamp match_stamp;
  MapId query_map;
  MapId match_map;
  std::optional<Se3> T_match_query;  // of verified candidates
  LoopEvidence evidence;
  LoopVerdict verdict = LoopVerdict::kRefused;
  std::string reason;
};

}  // namespace cslam
