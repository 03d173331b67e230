// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map.h"
#include "cslam/mapping/mapper_options.h"
#include "cslam/vision/measurement_model.h"

#include <span>

namespace cslam {

// Adjusts the points, held-back ones too, while all poses hold still: before points that took no
// part in bundle adjustment do so, or they would drag the poses. Observations that disagree are
// removed. Returns how many were.
int RefineStructure(Map& map, std::span<const PointId> points, const Camera& camera,
                    const DepthOptions& depth, const MeasurementModel& model,
                    const BundleAdjusterOptions& options);

}  // namespace cslam
