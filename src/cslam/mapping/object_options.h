// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/mapping/past_options.h"
#include "cslam/objects/expected_view.h"
#include "cslam/objects/object_classes.h"
#include "cslam/objects/persistence.h"

#include <string>

namespace cslam {

class OptionList;

// When evidence changes a belief.
enum class BeliefUpdate {
  kPerView,   // with every view that tells something
  kPerVisit,  // once, when the object was not seen for a while (the paper)
};

// What an object's centroid and box are made of.
enum class ExtentSource {
  kSurface,  // the surface measured by depth
  kPoints,   // its map points: mean, and medians of the 5 % outermost coordinates (the paper)
};

struct MapObjectOptions {
  bool enabled = true;
  std::string belief_update = "view";  // or "visit"
  int visit_gap_keyframes = 10;
  std::string extent = "surface";  // or "points"
  double voxel_m = 0.03;
  double min_overlap = 0.25;
  double same_surface = 0.6;
  double same_size = 0.7;
  double merge_overlap = 0.4;
  double max_union = 1.4;
  int min_voxels = 4;
  double min_likeness = 0.5;
  double sure_likeness = 0.75;
  double recognise_after_s = 2.0;
  double max_size_ratio = 2.0;
  double sure_max_size_ratio = 3.0;
  double replace_distance_m = 0.6;
  int min_views_before = 2;
  int settled_sightings = 8;
  double sweep_for_s = 10.0;
  double sweep_margin_m = 0.3;
  int max_strays = 3;
  int min_doubt_views = 15;
  double min_named_share = 0.2;
  double min_displaced = 0.4;
  int min_displacing_views = 3;
  PastOptions past;
  ObjectClassOptions classes;
  PersistenceOptions belief;
  ExpectedViewOptions view;
};
void Describe(OptionList& list, MapObjectOptions& options);

// Throw Error for an unknown name.
BeliefUpdate BeliefUpdateOf(const MapObjectOptions& options);
ExtentSource ExtentSourceOf(const MapObjectOptions& options);

}  // namespace cslam
