// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map.h"
#include "cslam/mapping/mapper_options.h"
#include "cslam/mapping/object_layer.h"
#include "cslam/messages/messages.h"
#include "cslam/vision/measurement_model.h"

#include <functional>
#include <memory>
#include <vector>

namespace cslam {

// Owns the map and is the only one to change it. Synchronous and single-threaded.
// For every proposal: Insert(), whose snapshot gives the tracker the new points before any
// optimisation, then Refine(), whose snapshot carries the optimised map.
class Mapper {
 public:
  Mapper(const Camera& camera, const OrbOptions& orb, const DepthOptions& depth,
         const MapperOptions& options);

  // Adds the keyframe, what it observes, and points from its own depth. A proposal whose
  // reference is unknown is refused (it belongs to a map from before a reset).
  MapUpdate Insert(const KeyframeProposal& proposal);

  // Works on the keyframe inserted last: culls points on probation, triangulates, fuses, adjusts
  // the local bundle, culls keyframes. should_stop ends the adjustment early; may be empty.
  MapUpdate Refine(const std::function<bool()>& should_stop = {});

  // What loop closing worked out on a snapshot, applied in one step; see mapping/correction.h. A
  // refused one changes nothing.
  MapUpdate Apply(const MapCorrection& correction);
  MapUpdate Apply(const PoseRefinement& refinement);

  void Reset();

  // Goes on in a map of an earlier run, whose pyramid must be this one's: throws Error otherwise.
  MapUpdate Continue(Map map);

  const Map& map() const { return map_; }

 private:
  MapUpdate Publish(MapUpdate update);
  MapUpdate Publish(CorrectionReport report, Stopwatch& watch);

  const Camera camera_;
  const ImageBounds bounds_;
  const DepthOptions depth_;
  const MapperOptions options_;
  const MeasurementModel model_;

  Map map_;
  ObjectLayer objects_;
  KeyframeId newest_;  // inserted last
  std::vector<PointId> on_probation_;
  std::uint64_t revision_ = 0;
  std::uint32_t proposals_applied_ = 0;
};

}  // namespace cslam
