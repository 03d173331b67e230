// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/objects/object_tracker.h"
#include "cslam/optim/pose_optimizer.h"
#include "cslam/tracking/object_watch.h"
#include "cslam/vision/frame_features.h"
#include "cslam/vision/orb.h"

namespace cslam {

class OptionList;

struct KeyframePolicyOptions {
  int min_inliers = 15;
  int max_interval_frames = 10;
  double reference_ratio = 0.75;
  double reference_ratio_first = 0.4;
  int near_tracked_low = 100;
  int near_creatable_high = 70;
  int max_in_flight = 3;
};
void Describe(OptionList& list, KeyframePolicyOptions& options);

struct LocalMapOptions {
  int max_keyframes = 60;
  int neighbours_per_keyframe = 10;
  int min_shared_points = 15;
  double max_view_angle_deg = 60.0;
  double radius_frontal_px = 2.5;
  double radius_oblique_px = 4.0;
  double radius_factor = 3.0;
  double match_ratio = 0.8;
  int match_distance = 100;
};
void Describe(OptionList& list, LocalMapOptions& options);

struct TrackerOptions {
  OrbOptions orb;
  DepthOptions depth;
  // Gates four times the 95 % quantiles: motion blur shifts most corners of a frame by more than
  // the nominal sigma, and a pose from many is better than one from the few that moved least.
  PoseOptimizerOptions pose{.chi2_mono = 4.0 * 5.991, .chi2_depth = 4.0 * 7.815};
  KeyframePolicyOptions keyframe;
  LocalMapOptions local_map;
  ObjectTrackerOptions objects;
  ObjectWatchOptions watch;

  int repopulate_below = 700;
  bool report_keypoints = false;
  int min_initial_points = 100;
  double last_frame_radius_px = 15.0;
  int min_last_frame_matches = 20;
  int min_reference_matches = 15;
  int min_first_inliers = 10;
  int min_inliers = 30;
  double min_inlier_share = 0.4;
  int sure_inliers = 100;
  int use_provisional_below = 100;
  int use_held_back_below = 600;
  int min_room_matches = 400;
  int full_trust_views = 8;
  double recently_lost_s = 2.0;
  double max_jump_m = 0.2;
  double max_speed_m_s = 2.0;
  double max_jump_deg = 15.0;
  double max_turn_deg_s = 240.0;
  int reference_match_distance = 50;
  double reference_match_ratio = 0.7;
  double max_hint_age_s = 0.5;
  double hint_radius_factor = 3.0;
  int min_relocalised_inliers = 50;
};
void Describe(OptionList& list, TrackerOptions& options);

}  // namespace cslam
