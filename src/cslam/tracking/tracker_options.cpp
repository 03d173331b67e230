// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/tracking/tracker_options.h"

#include "cslam/util/options.h"

namespace cslam {

void Describe(OptionList& list, KeyframePolicyOptions& o) {
  list.Add("min_inliers", o.min_inliers, {1, 10'000}, "matches",
           "Fewest inliers for a frame to be trusted as a keyframe.");
  list.Add("max_interval", o.max_interval_frames, {1, 100'000}, "frames",
           "Insert at the latest this many frames after the last keyframe.");
  list.Add("reference_ratio", o.reference_ratio, {0.0, 1.0}, "",
           "Insert when inliers fall below this share of the reference keyframe's points.");
  list.Add("reference_ratio_first", o.reference_ratio_first, {0.0, 1.0}, "",
           "The same while the map has a single keyframe.");
  list.Add("near_tracked_low", o.near_tracked_low, {0, 10'000}, "points",
           "Fewer tracked near points than this call for a keyframe ...");
  list.Add("near_creatable_high", o.near_creatable_high, {0, 10'000}, "points",
           "... if more than this many near points could be made.");
  list.Add("max_in_flight", o.max_in_flight, {1, 100}, "keyframes",
           "No further proposal while this many have not been applied.");
}

void Describe(OptionList& list, LocalMapOptions& o) {
  list.Add("max_keyframes", o.max_keyframes, {1, 1000}, "keyframes",
           "Largest local map: keyframes that share points with the frame, and neighbours.");
  list.Add("neighbours_per_keyframe", o.neighbours_per_keyframe, {0, 100}, "keyframes",
           "Covisible keyframes considered for each keyframe that shares points.");
  list.Add("min_shared_points", o.min_shared_points, {1, 1000}, "points",
           "Points two keyframes share to count as neighbours.");
  list.Add("max_view_angle", o.max_view_angle_deg, {1.0, 90.0}, "deg",
           "A point is expected only within this angle of its mean viewing direction.");
  list.Add("radius_frontal", o.radius_frontal_px, {0.5, 50.0}, "px",
           "Search radius at level 0 when a point is seen from its mean direction.");
  list.Add("radius_oblique", o.radius_oblique_px, {0.5, 50.0}, "px",
           "Search radius at level 0 when it is seen from elsewhere.");
  list.Add("radius_factor", o.radius_factor, {0.5, 20.0}, "",
           "Widens both radii: RGB-D poses are predicted from noisy depth.");
  list.Add("match_ratio", o.match_ratio, {0.1, 1.0}, "",
           "Best descriptor distance over second best at the same level.");
  list.Add("match_distance", o.match_distance, {1, 256}, "bits",
           "Most differing descriptor bits of a match by projection.");
}

void Describe(OptionList& list, TrackerOptions& o) {
  list.Group("orb", o.orb);
  list.Group("depth", o.depth);
  list.Group("pose", o.pose);
  list.Group("keyframe", o.keyframe);
  list.Group("local_map", o.local_map);
  list.Group("objects", o.objects);
  list.Group("watch", o.watch);
  list.Add("repopulate_below", o.repopulate_below, {0, 100'000}, "keypoints",
           "With fewer keypoints off dynamic things, more are taken from the background.");
  list.Add("report_keypoints", o.report_keypoints,
           "Hand every keypoint and its label to the sinks, as pictures need them.");
  list.Add("min_initial_points", o.min_initial_points, {10, 10'000}, "points",
           "Keypoints with depth that a map's first frame needs.");
  list.Add("last_frame_radius", o.last_frame_radius_px, {1.0, 200.0}, "px",
           "Search radius around the motion model's prediction, at level 0; doubled on failure.");
  list.Add("min_last_frame_matches", o.min_last_frame_matches, {4, 1000}, "matches",
           "Matches with the last frame for the motion model to be believed.");
  list.Add("min_reference_matches", o.min_reference_matches, {4, 1000}, "matches",
           "Matches with the reference keyframe for the fallback to be believed.");
  list.Add("min_first_inliers", o.min_first_inliers, {3, 1000}, "matches",
           "Inliers of the first pose estimate, before the local map is searched.");
  list.Add("min_inliers", o.min_inliers, {5, 1000}, "matches",
           "Inliers of the final pose; with fewer the frame is not tracked.");
  list.Add(
      "min_inlier_share", o.min_inlier_share, {0.0, 1.0}, "",
      "Smallest share of the map matches that agrees with the final pose: right poses have 45 % "
      "and more, wrong ones 20 to 40 % ...");
  list.Add("sure_inliers", o.sure_inliers, {0, 10'000}, "matches",
           "... but so many inliers suffice whatever their share.");
  list.Add("use_provisional_below", o.use_provisional_below, {0, 10'000}, "matches",
           "With fewer map matches the final pose also uses the last frame's own depth points.");
  list.Add("full_trust_views", o.full_trust_views, {1, 1000}, "keyframes",
           "A point seen from fewer counts the less in a pose, in proportion: who walks into the "
           "picture brings new points that move alike.");
  list.Add("use_held_back_below", o.use_held_back_below, {0, 10'000}, "matches",
           "With fewer matched points of the room, those of objects that rest but are not believed "
           "in yet count for the pose as well, half as many as the room's at most ...");
  list.Add("min_room_matches", o.min_room_matches, {0, 10'000}, "matches",
           "... or all of them, with fewer than this: a room full of furniture must not get lost.");
  list.Add("recently_lost_time", o.recently_lost_s, {0.0, 1000.0}, "s",
           "How long the map is searched for lost frames, or for the first ones of a run that goes "
           "on in a given map, before a new map may start.");
  list.Add(
      "max_jump", o.max_jump_m, {0.0, 100.0}, "m",
      "A pose found without prediction counts if it is no further from the last than this ...");
  list.Add("max_speed", o.max_speed_m_s, {0.0, 1000.0}, "m/s",
           "... plus this times the time since: people walk at 1.4 m/s ...");
  list.Add("max_jump_angle", o.max_jump_deg, {0.0, 180.0}, "deg",
           "... and not turned further than this ...");
  list.Add("max_turn_rate", o.max_turn_deg_s, {0.0, 3600.0}, "deg/s",
           "... plus this times the time: hands turn a camera by up to 200 deg/s.");
  list.Add("reference_match_distance", o.reference_match_distance, {1, 256}, "bits",
           "Most differing descriptor bits of a match without prediction.");
  list.Add("reference_match_ratio", o.reference_match_ratio, {0.1, 1.0}, "",
           "Best descriptor distance over second best of a match without prediction.");
  list.Add("max_hint_age", o.max_hint_age_s, {0.0, 60.0}, "s",
           "A lost frame's recognised place is of use for frames this much later.");
  list.Add("hint_radius_factor", o.hint_radius_factor, {1.0, 20.0}, "",
           "Widens the search around a recognised place: the camera has moved on since.");
  list.Add("min_relocalised_inliers", o.min_relocalised_inliers, {10, 1000}, "matches",
           "Inliers that a frame needs for tracking to go on at a recognised place.");
}

}  // namespace cslam
