// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/visibility.h"
#include "cslam/scene_eval/scene_truth.h"

#include <limits>
#include <optional>
#include <span>
#include <vector>

// When a camera first had a clear view of a place, told from true poses and depth images: from then
// on a perfect system could know what stands there.

namespace cslam {

struct ClearViewOptions {
  double max_distance_m = 5.0;   // of the place's middle; farther things are small and noisy
  double min_clear_share = 0.6;  // of points in the place: in the picture, and nothing before them
  // Depth nearer than the place by less does not hide it: noise at 5 m, and what it stands on.
  double occluder_margin_m = 0.05;
  int min_frames = 3;  // one after the other: a glance is no clear view
  // Of the picture, that a thing's visible pixels fill: 300 px of 640 x 480.
  double min_picture_share = 0.001;
  // Frames after the one and before the other do not count: no session saw them.
  double gap_from_s = std::numeric_limits<double>::infinity();
  double gap_to_s = -std::numeric_limits<double>::infinity();
};

// A place and the time in which a view of it counts.
struct PlaceQuery {
  PlacedBox box = {};
  double from_s = 0.0;  // since the sequence's start
  double until_s = 0.0;
  int shown_instance = 0;  // not 0: enough pixels of this instance must be visible as well
};

// Never answered.
PlaceQuery NoQuery();

// Asks for what replaced a thing that left its place at that time (changes.json says what);
// NoQuery() if nothing did. Who sees it knows that the old thing is gone, though it may hide the
// place.
PlaceQuery ReplacementQuery(const SceneTruth& truth, int instance, double left_s, double until_s);

// For each query the time of the first frame of its first clear view, if there is one. Looks
// through the frames once, and opens only depth images that may answer a question.
std::vector<std::optional<double>> FirstClearViews(const SceneTruth& truth,
                                                   std::span<const PlaceQuery> queries,
                                                   const ClearViewOptions& options = {});

// Where the camera sees a point, raw pixel; nothing outside the picture or behind the camera.
struct PixelPlace {
  int u = 0;
  int v = 0;
};
std::optional<PixelPlace> PixelOf(const Camera& camera, const Eigen::Vector3d& p_camera);

// Whether the middle of the box is near enough and enough of its points are in the picture.
bool IsInFrustum(const PlacedBox& box, const Camera& camera, const Se3& T_world_camera,
                 const ClearViewOptions& options);

}  // namespace cslam
