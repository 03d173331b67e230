// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/loop_options.h"

#include "cslam/util/options.h"

namespace cslam {

void Describe(OptionList& list, DepthCheckOptions& o) {
  list.Add("keyframes_per_side", o.keyframes_per_side, {1, 100}, "keyframes",
           "Keyframes on each side of a loop whose depth is compared.");
  list.Add(
      "tolerance", o.tolerance_m, {0.0, 10.0}, "m",
      "A surface contradicts a keyframe that saw through it if it stands this much nearer ...");
  list.Add("tolerance_per_m2", o.tolerance_per_m2, {0.0, 1.0}, "1/m",
           "... plus this much per squared metre of depth, as sensor noise grows.");
  list.Add("max_contradicted", o.max_contradicted, {0.0, 1.0}, "",
           "Loops with a larger share of contradicting depth readings are refused. Not 0: things "
           "move between two visits.");
  list.Add("min_compared", o.min_compared, {0, 1'000'000}, "readings",
           "Loops in which fewer readings of the two sides meet are refused.");
}

void Describe(OptionList& list, EssentialGraphOptions& o) {
  list.Add("min_shared_points", o.min_shared_points, {1, 10'000}, "points",
           "Points two keyframes share to be tied together while a loop is spread.");
  list.Add("sigma_angle", o.sigma_deg, {1e-6, 90.0}, "deg",
           "Standard deviation of an edge's rotation; with the next, how a loop's error is shared "
           "between rotations and translations.");
  list.Add("sigma_position", o.sigma_m, {1e-6, 10.0}, "m",
           "Standard deviation of an edge's translation.");
  list.Group("solver", o.solver);
}

void Describe(OptionList& list, LoopFusionOptions& o) {
  list.Add("keyframes_per_side", o.keyframes_per_side, {1, 100}, "keyframes",
           "Keyframes on each side of a loop whose points are fused.");
  list.Add("radius", o.radius_px, {0.5, 50.0}, "px",
           "Search radius at level 0 around a point's projection after the correction.");
  list.Add("match_distance", o.match_distance, {1, 256}, "bits",
           "Most differing descriptor bits of two sightings of one point.");
}

void Describe(OptionList& list, OverlapCheckOptions& o) {
  list.Add("max_keyframes", o.max_keyframes, {1, 10'000}, "keyframes",
           "Keyframes of the map that moves that are held against the other, spread over time.");
  list.Add("max_distance", o.max_distance_m, {0.0, 100.0}, "m",
           "Two keyframes look at the same if they stand no further apart than this ...");
  list.Add("max_angle", o.max_angle_deg, {0.0, 180.0}, "deg", "... and are turned no further.");
  list.Add("min_expected", o.min_expected, {1, 10'000}, "points",
           "With fewer points of the one in the view of the other nothing is said.");
  list.Add("min_found_share", o.min_found_share, {0.0, 1.0}, "",
           "Two keyframes contradict each other if a smaller share of the points is found.");
  list.Add("max_contradicting", o.max_contradicting, {0.0, 1.0}, "",
           "Two maps are not merged if a larger share of the keyframes contradict.");
}

namespace {

void DescribeCandidates(OptionList& list, LoopOptions& o) {
  list.Group("candidates", o.candidates);
  list.Add("min_shared_points", o.min_shared_points, {1, 1000}, "points",
           "Points two keyframes share to count as neighbours.");
  list.Add("min_keyframes_apart", o.min_keyframes_apart, {1, 10'000}, "keyframes",
           "Nearer keyframes of the same map are no candidates.");
}

void DescribeEvidence(OptionList& list, LoopOptions& o) {
  list.Group("verification", o.verification);
  list.Add("use_objects", o.use_objects,
           "Let points of the map's objects prove a loop, too. Nobody knows where they went while "
           "nobody looked; off: the room has to prove it.");
  list.Add("confirmations", o.confirmations, {1, 100}, "keyframes",
           "Keyframes that have to find the same place and agree where it is, within one map.");
  list.Add("merge_confirmations", o.merge_confirmations, {1, 100}, "keyframes",
           "The same for two maps, about whose drift against each other nothing is known.");
  list.Add("confirming_neighbours", o.confirming_neighbours, {0, 100}, "keyframes",
           "Neighbours of a keyframe that are asked at once, without waiting for later ones.");
  list.Add("max_missed", o.max_missed, {0, 100}, "keyframes",
           "Later keyframes that may miss a place before it is forgotten.");
  list.Add("agreement", o.agreement_m, {0.0, 10.0}, "m",
           "How far apart two keyframes may place it ...");
  list.Add("agreement_angle", o.agreement_deg, {0.0, 180.0}, "deg", "... and how far turned.");
}

void DescribeDrift(OptionList& list, LoopOptions& o) {
  list.Add("max_drift", o.max_drift_m, {0.0, 1000.0}, "m",
           "Loops that move the newer end further are refused: drift of depth cameras is a few "
           "percent of the way, look-alike places are metres apart. This much always ...");
  list.Add("max_drift_share", o.max_drift_share, {0.0, 1.0}, "",
           "... plus this share of the way between the two visits.");
  list.Add("max_drift_angle", o.max_drift_deg, {0.0, 180.0}, "deg",
           "Loops that turn the newer end further are refused: this much always ...");
  list.Add("max_drift_angle_per_m", o.max_drift_deg_per_m, {0.0, 180.0}, "deg/m",
           "... plus this much per metre of the way.");
  list.Add("max_speed", o.max_speed_m_s, {0.0, 1000.0}, "m/s",
           "Two maps are not merged if the camera would have had to travel faster (plus max_drift) "
           "from the one to the other: a walk is 1.4 m/s.");
  list.Add("min_drift", o.min_drift_m, {0.0, 10.0}, "m",
           "A loop that moves less than this and turns less than the next only fuses points: one "
           "frame's pose is no more exact than the map is.");
  list.Add("min_drift_angle", o.min_drift_deg, {0.0, 90.0}, "deg", "See min_drift.");
}

}  // namespace

void Describe(OptionList& list, LoopOptions& o) {
  DescribeCandidates(list, o);
  DescribeEvidence(list, o);
  DescribeDrift(list, o);
  list.Group("depth_check", o.depth_check);
  list.Group("graph", o.graph);
  list.Group("fusion", o.fusion);
  list.Group("overlap", o.overlap);
}

}  // namespace cslam
