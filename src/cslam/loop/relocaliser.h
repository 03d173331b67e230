// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/loop/geometric_verification.h"
#include "cslam/loop/loop_options.h"
#include "cslam/loop/place_candidates.h"
#include "cslam/loop/place_index.h"
#include "cslam/map/map_view.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace cslam {

class OptionList;

struct RelocaliserOptions {
  CandidateOptions candidates;
  int sure_inliers = 150;
  double rival_ratio = 0.7;
  double rival_distance_m = 0.5;
  double rival_angle_deg = 20.0;
  DepthCheckOptions depth_check;
  VerificationOptions verification;
};
void Describe(OptionList& list, RelocaliserOptions& options);

// Where a frame was taken.
struct RelocatedFrame {
  MapId map;
  Se3 T_world_camera;    // in that map
  KeyframeId reference;  // sees most of the points found
  Se3 T_reference_camera;
  std::vector<PointId> points;  // one per feature; invalid = none
};

struct RelocalisationResult {
  std::optional<RelocatedFrame> found;
  std::string reason;                       // why it was found, or why not
  std::vector<PlaceCandidate> candidates;   // those verified, in order
  std::vector<PlaceVerification> attempts;  // one for each
};

// Which maps to search; an empty one accepts all.
using MapFilter = std::function<bool(MapId)>;

// Finds where a frame was taken, knowing nothing but the map. Keeps no state between calls, and
// changes neither map nor index.
class Relocaliser {
 public:
  Relocaliser(PlaceSensor sensor, const RelocaliserOptions& options);

  // Searches all maps of the atlas that may be searched. The index may hold keyframes that the map
  // no longer has. depth_small_mm: the frame's thumbnail, to be held against the map's; may be
  // empty.
  RelocalisationResult Find(const FrameFeatures& features, const MapView& map,
                            const PlaceIndex& index, const MapFilter& may_search = {},
                            const cv::Mat& depth_small_mm = {}) const;

 private:
  PlaceVerification Verify(const FrameFeatures& features, const MapView& map, KeyframeId candidate,
                           const cv::Mat& depth_small_mm) const;

  PlaceSensor sensor_;
  RelocaliserOptions options_;
};

}  // namespace cslam
