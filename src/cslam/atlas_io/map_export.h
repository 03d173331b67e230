// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/geometry/trajectory.h"
#include "cslam/io/point_cloud_file.h"
#include "cslam/map/map_view.h"

#include <vector>

namespace cslam {

// The points of one map of the atlas, by id, in its world frame. A map keeps no colours.
std::vector<ColoredPoint> SparseCloud(const MapView& map, MapId map_id);

struct DenseCloudOptions {
  double voxel_m = 0.02;     // one point is left in each cube of this side
  double max_depth_m = 4.0;  // farther readings of a structured-light camera scatter over voxels
};

// The depth the keyframes of one map measured, people and what moved left out, as the mean of the
// readings in each voxel. In order of the voxels.
std::vector<ColoredPoint> DenseCloud(const MapView& map, MapId map_id, const Camera& camera,
                                     const DenseCloudOptions& options = {});

// The keyframes of one map in order of time. Of several with one stamp (a sequence that was run
// twice into one map) the oldest counts.
Trajectory KeyframeTrajectory(const MapView& map, MapId map_id);

}  // namespace cslam
