// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/navigation/surface_elements.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace cslam {

class OptionList;

struct FloorOptions {
  double max_tilt_deg = 40.0;    // of the mean camera's upright against true up
  double normal_tol_deg = 10.0;  // for a surface element to be horizontal; noise of depth
  double plane_tol_m = 0.08;     // thickness of the floor: depth noise and drift
  double min_share = 0.15;       // of the largest horizontal surface, for a lower one to count
  int num_hypotheses = 200;
};
void Describe(OptionList& list, FloorOptions& options);

// A plane: p is height_m = up_world.dot(p) - offset_m above it.
struct Floor {
  Eigen::Vector3d up_world = -Eigen::Vector3d::UnitY();
  double offset_m = 0.0;
  bool is_seen = false;  // false: no horizontal surface was found, it is only assumed

  double HeightM(const Eigen::Vector3d& p_world) const { return up_world.dot(p_world) - offset_m; }
};

// The lowest large horizontal surface. up_prior: about upwards, e.g. the mean of the cameras'
// upright. RANSAC over the normals tells the vertical, as most horizontal surfaces in a building
// are parallel; then the heights tell the floor. Deterministic.
Floor EstimateFloor(std::span<const SurfaceElement> elements, const Eigen::Vector3d& up_prior,
                    const FloorOptions& options);

// The same from the depth of keyframes (not empty; all of the size of rays).
Floor EstimateFloor(const std::vector<const Keyframe*>& keyframes, const PixelRays& rays,
                    double max_depth_m, const FloorOptions& options);

}  // namespace cslam
