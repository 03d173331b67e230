// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/loop/pose_ransac.h"
#include "cslam/map/map_view.h"
#include "cslam/optim/pose_optimizer.h"
#include "cslam/vision/frame_features.h"
#include "cslam/vision/measurement_model.h"
#include "cslam/vision/orb.h"

#include <functional>
#include <string>
#include <vector>

namespace cslam {

class OptionList;

struct VerificationOptions {
  int neighbours = 5;
  int match_distance = 70;
  double match_ratio = 0.85;
  int min_matches = 15;
  int min_ransac_inliers = 10;
  PoseRansacOptions ransac{};
  double first_radius_px = 12.0;
  double second_radius_px = 6.0;
  int guided_distance = 80;
  double guided_ratio = 0.8;
  int max_local_keyframes = 30;
  double max_view_angle_deg = 60.0;
  PoseOptimizerOptions pose{.chi2_mono = 4.0 * 5.991, .chi2_depth = 4.0 * 7.815};
  int min_inliers = 30;
  int min_cells = 5;
  double min_found_share = 0.05;
};
void Describe(OptionList& list, VerificationOptions& options);

// What measures: the camera and how well.
struct PlaceSensor {
  Camera camera;
  ImageBounds bounds;
  double baseline_m = 0.0;  // of the virtual stereo pair that depth is expressed in
  MeasurementModel model;
};
PlaceSensor MakePlaceSensor(const Camera& camera, const OrbOptions& orb, const DepthOptions& depth);

enum class VerificationOutcome : std::uint8_t {
  kAccepted,
  kFewMatches,     // descriptors in common
  kNoPose,         // no pose that enough of the matches agree with
  kFewInliers,     // after guided matching
  kBadlySpread,    // inliers in few parts of the image only
  kMissingPoints,  // most of what should be in view is not found
  kContradicted,   // by measured depth
};

// Where a frame was taken, if it was taken at the place, and what speaks for it.
struct PlaceVerification {
  VerificationOutcome outcome = VerificationOutcome::kFewMatches;
  std::string reason;  // "62 inliers", "11 inliers < 30", ...
  KeyframeId candidate;

  int num_matches = 0;         // by descriptor alone
  int num_ransac_inliers = 0;  // of those
  int ransac_iterations = 0;

  Se3 T_world_camera;           // in the candidate's map; meaningful from kFewInliers on
  std::vector<PointId> points;  // one per feature: the inlier found there, or invalid
  int num_inliers = 0;          // map points whose error passes the gates of options.pose
  int num_strict_inliers = 0;   // of those, errors within the 95 % quantiles of chi2
  int num_expected = 0;         // map points that should have been in view
  int num_cells = 0;            // of the 16 cells of a 4 x 4 grid over the image with an inlier
  double median_error_px = 0.0;

  bool IsAccepted() const { return outcome == VerificationOutcome::kAccepted; }
  double spread() const { return num_cells / 16.0; }  // 0 to 1
};

// Whether a point may serve as evidence; an empty one accepts every usable point.
using PointFilter = std::function<bool(const MapPoint&)>;

// Checks whether the frame that measured features shows the place of an alive keyframe.
//
// Matches the features by their looks with the points of the candidate and its best neighbours,
// finds a pose by RANSAC (seeded by the candidate's id), then searches the map around that pose for
// more, twice. The matches RANSAC judged were made without knowing the pose: their number is the
// evidence that the place is right. Inliers of guided matching make the pose exact.
PlaceVerification VerifyPlace(const FrameFeatures& features, const MapView& map,
                              KeyframeId candidate, const PlaceSensor& sensor,
                              const VerificationOptions& options, const PointFilter& may_use = {});

}  // namespace cslam
