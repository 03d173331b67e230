// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map.h"
#include "cslam/mapping/mapper_options.h"
#include "cslam/vision/measurement_model.h"

#include <functional>

namespace cslam {

struct LocalBaReport {
  int num_keyframes = 0;  // free ones
  int num_points = 0;
  int iterations = 0;
  int outliers_removed = 0;
  bool was_stopped = false;
};

// Adjusts the keyframe, its best neighbours and all points they see; other observers of the
// points hold still. Observations the solution disagrees with are removed from the map.
LocalBaReport AdjustLocally(Map& map, KeyframeId keyframe, const Camera& camera,
                            const DepthOptions& depth, const MeasurementModel& model,
                            int min_shared_points, const LocalBaOptions& options,
                            const std::function<bool()>& should_stop);

}  // namespace cslam
