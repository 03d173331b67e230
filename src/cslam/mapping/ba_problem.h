// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map_view.h"
#include "cslam/optim/bundle_adjuster.h"
#include "cslam/vision/measurement_model.h"

#include <span>
#include <vector>

namespace cslam {

// The keyframes' poses, the points, and what the ones saw of the others, in the given order; no
// pose is fixed yet. All ids must be alive.
BaProblem MakeBaProblem(const MapView& map, std::span<const KeyframeId> keyframes,
                        std::span<const PointId> points, const Camera& camera,
                        const DepthOptions& depth, const MeasurementModel& model);

// The usable points seen by the keyframes, each once, in the order they are met.
std::vector<PointId> PointsSeenBy(const MapView& map, std::span<const KeyframeId> keyframes);

}  // namespace cslam
