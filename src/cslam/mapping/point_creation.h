// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map.h"
#include "cslam/mapping/mapper_options.h"
#include "cslam/vision/measurement_model.h"

#include <vector>

namespace cslam {

// Makes points from the keyframe's own depth readings: every near one, and farther ones, nearest
// first, until min_near_points keypoints have a point. Returns the new points.
std::vector<PointId> CreatePointsFromDepth(Map& map, KeyframeId keyframe, const Camera& camera,
                                           const DepthOptions& depth, int min_near_points);

// Triangulates keypoints that have no point yet with those of covisible keyframes.
std::vector<PointId> TriangulatePoints(Map& map, KeyframeId keyframe, const Camera& camera,
                                       const MeasurementModel& model, int min_shared_points,
                                       const TriangulationOptions& options);

}  // namespace cslam
