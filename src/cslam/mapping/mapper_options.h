// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/mapping/object_options.h"
#include "cslam/optim/bundle_adjuster.h"
#include "cslam/vision/frame_features.h"
#include "cslam/vision/orb.h"

namespace cslam {

class OptionList;

struct TriangulationOptions {
  int neighbours = 10;
  double min_baseline_m = 0.08;
  double min_parallax_deg = 0.5;
  double max_epipolar_chi2 = 3.84;
  int match_distance = 50;
  double match_ratio = 0.8;
};
void Describe(OptionList& list, TriangulationOptions& options);

struct FusionOptions {
  int neighbours = 10;
  int second_neighbours = 5;
  int nearby_keyframes = 5;
  double nearby_distance_m = 1.0;
  double nearby_angle_deg = 45.0;
  double radius_px = 3.0;
  int match_distance = 50;
};
void Describe(OptionList& list, FusionOptions& options);

struct CullingOptions {
  double min_found_ratio = 0.25;
  int min_observations = 2;
  int probation_keyframes = 3;
  double redundant_share = 0.9;
  int redundant_observers = 3;
};
void Describe(OptionList& list, CullingOptions& options);

struct LocalBaOptions {
  BundleAdjusterOptions solver;
  int max_keyframes = 20;
  int max_fixed_keyframes = 20;
};
void Describe(OptionList& list, LocalBaOptions& options);

struct MapperOptions {
  int min_near_points = 100;
  int min_shared_points = 15;
  TriangulationOptions triangulation;
  FusionOptions fusion;
  CullingOptions culling;
  LocalBaOptions local_ba;
  MapObjectOptions objects;
  bool check_invariants = false;
};
void Describe(OptionList& list, MapperOptions& options);

}  // namespace cslam
