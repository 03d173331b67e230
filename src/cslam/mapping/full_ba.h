// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map_view.h"
#include "cslam/messages/loop_messages.h"
#include "cslam/optim/bundle_adjuster.h"
#include "cslam/vision/measurement_model.h"

#include <functional>
#include <optional>

namespace cslam {

class OptionList;

struct FullBaOptions {
  // After a loop the poses are centimetres off, and long chains settle slowly.
  BundleAdjusterOptions solver{.iterations_robust = 10, .iterations_final = 20};
  int min_observations = 2;  // keyframes; points seen by fewer say nothing about the poses
};
void Describe(OptionList& list, FullBaOptions& options);

// Adjusts every keyframe and every point of one map of a snapshot; the map's first keyframe holds
// still. For ApplyRefinement(). nullopt when should_stop (may be empty) ended it, or when there is
// nothing to adjust.
std::optional<PoseRefinement> AdjustFully(const MapView& map, MapId id, const Camera& camera,
                                          const DepthOptions& depth, const MeasurementModel& model,
                                          const FullBaOptions& options,
                                          const std::function<bool()>& should_stop = {});

}  // namespace cslam
