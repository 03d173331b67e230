// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/loop/geometric_verification.h"
#include "cslam/loop/place_candidates.h"
#include "cslam/optim/pose_graph.h"

namespace cslam {

class OptionList;

// When measured depth contradicts a loop.
struct DepthCheckOptions {
  int keyframes_per_side = 3;
  // A surface this much nearer than what a keyframe saw there stands in space seen through: the
  // noise of a structured-light sensor grows with the square of depth (2.5 mm/m^2: twice the
  // standard deviation of a Kinect), the rest is for poses and edges.
  double tolerance_m = 0.08;
  double tolerance_per_m2 = 0.005;
  double max_contradicted = 0.2;
  int min_compared = 200;
};
void Describe(OptionList& list, DepthCheckOptions& options);

struct EssentialGraphOptions {
  int min_shared_points = 100;
  // Of the relative pose of two keyframes that share points: equal for all, so drift is shared out
  // evenly over the way.
  double sigma_deg = 0.2;
  double sigma_m = 0.01;
  PoseGraphOptions solver;
};
void Describe(OptionList& list, EssentialGraphOptions& options);

struct LoopFusionOptions {
  int keyframes_per_side = 10;
  double radius_px = 4.0;
  int match_distance = 50;
};
void Describe(OptionList& list, LoopFusionOptions& options);

// When what two maps know of the same places contradicts that they are one.
struct OverlapCheckOptions {
  int max_keyframes = 40;
  double max_distance_m = 1.0;
  double max_angle_deg = 30.0;
  int min_expected = 50;
  double min_found_share = 0.1;
  double max_contradicting = 0.25;
};
void Describe(OptionList& list, OverlapCheckOptions& options);

struct LoopOptions {
  CandidateOptions candidates{.max_candidates = 3};
  int min_shared_points = 15;
  int min_keyframes_apart = 10;
  // Stricter than for finding a frame: a wrong pose is gone with the next frame, a wrong loop
  // stays.
  VerificationOptions verification{.min_ransac_inliers = 15, .min_inliers = 40, .min_cells = 6};
  bool use_objects = false;  // let things prove a loop, which may have been moved
  int confirmations = 3;
  int merge_confirmations = 3;
  int confirming_neighbours = 5;
  int max_missed = 2;
  double agreement_m = 0.10;
  double agreement_deg = 3.0;
  double max_drift_m = 0.3;
  double max_drift_share = 0.05;
  double max_drift_deg = 10.0;
  double max_drift_deg_per_m = 1.0;
  double max_speed_m_s = 1.5;
  double min_drift_m = 0.01;
  double min_drift_deg = 0.5;
  // Measured: true loops 0.01 at most; by the way of a moved chair 0.04 and more, where two
  // keyframes agree.
  DepthCheckOptions depth_check{.max_contradicted = 0.02};
  EssentialGraphOptions graph;
  LoopFusionOptions fusion;
  OverlapCheckOptions overlap;
};
void Describe(OptionList& list, LoopOptions& options);

}  // namespace cslam
