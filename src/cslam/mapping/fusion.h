// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map.h"
#include "cslam/mapping/mapper_options.h"
#include "cslam/vision/measurement_model.h"

namespace cslam {

// Finds points of the keyframe in its neighbours and points of the neighbours in the keyframe:
// a keypoint without a point gains an observation, two points that turn out to be one are fused
// into the better observed. Returns how many observations and fusions were made.
int FuseWithNeighbours(Map& map, KeyframeId keyframe, const Camera& camera,
                       const ImageBounds& bounds, const DepthOptions& depth,
                       const MeasurementModel& model, int min_shared_points,
                       const FusionOptions& options);

}  // namespace cslam
