// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/loop/geometric_verification.h"
#include "cslam/loop/loop_options.h"
#include "cslam/map/map_view.h"
#include "cslam/messages/loop_messages.h"

#include <span>
#include <vector>

namespace cslam {

// A map as it will be after a correction.
class CorrectedView {
 public:
  CorrectedView(const MapView& map, std::span<const KeyframeMove> moves);

  const MapView& map() const { return map_; }
  Se3 T_world_camera(const Keyframe& keyframe) const;
  Eigen::Vector3d p_world(const MapPoint& point) const;

 private:
  const MapView& map_;
  std::vector<Se3> moves_;  // by keyframe
};

struct LoopFusions {
  std::vector<PointPair> pairs;
  std::vector<FoundPoint> found;
};

// How many of the points a keyframe should see it sees.
struct PointRecall {
  int num_expected = 0;
  int num_found = 0;
};
PointRecall RecallPoints(const CorrectedView& view, KeyframeId keyframe,
                         std::span<const PointId> points, const PlaceSensor& sensor,
                         const LoopFusionOptions& options);

// Looks for the points of one side of a loop in the keyframes of the other, where they appear once
// the correction is applied. A point of the moving side is paired with the one it is found as most
// often.
LoopFusions FindFusions(const CorrectedView& view, std::span<const KeyframeId> moving_side,
                        std::span<const PointId> points_of_fixed_side, const PlaceSensor& sensor,
                        const LoopFusionOptions& options);

}  // namespace cslam
