// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map_view.h"
#include "cslam/vision/pixel_rays.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace cslam {

// The alive keyframes of one map that have depth, by id; all of one size.
std::vector<const Keyframe*> KeyframesWithDepth(const MapView& map, MapId map_id);

// One surface element that a keyframe saw, in the world.
struct SurfaceElement {
  Eigen::Vector3d p_world;
  Eigen::Vector3d normal_world;  // towards the camera
  double area_m2 = 0.0;          // about; far pixels cover more
};

// Surface elements on a lattice of every step-th pixel, where depth is smooth and not beyond
// max_depth_m.
std::vector<SurfaceElement> SurfaceElements(const Keyframe& keyframe, const PixelRays& rays,
                                            int step, double max_depth_m);

}  // namespace cslam
