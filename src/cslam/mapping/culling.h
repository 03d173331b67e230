// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map.h"
#include "cslam/mapping/mapper_options.h"
#include "cslam/vision/measurement_model.h"

#include <vector>

namespace cslam {

struct PointCulling {
  std::vector<PointId> still_on_probation;
  int num_erased = 0;
};

// Erases points on probation that are rarely found or that too few keyframes see.
PointCulling CullPointsOnProbation(Map& map, const std::vector<PointId>& on_probation,
                                   KeyframeId newest, const CullingOptions& options);

// Culls neighbours of the keyframe nearly all of whose near points are well seen without them.
int CullRedundantKeyframes(Map& map, KeyframeId newest, const DepthOptions& depth,
                           int min_shared_points, const CullingOptions& options);

}  // namespace cslam
