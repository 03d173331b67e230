// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/util/id.h"
#include "cslam/vision/features.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace cslam {

// A keyframe's keypoint in which a point was found.
struct PointObservation {
  KeyframeId keyframe;
  std::int32_t keypoint = 0;

  bool operator==(const PointObservation&) const = default;
};

enum class PointState : std::uint8_t {
  kActive,
  kFused,   // continues as replaced_by
  kErased,  // gone; the id stays taken
};

// A landmark. Plain data: only Map changes it.
struct MapPoint {
  PointId id;
  PointState state = PointState::kActive;
  PointId replaced_by;  // of a fused point
  MapId map;

  Eigen::Vector3d p_world = Eigen::Vector3d::Zero();  // metres
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();   // unit, mean direction observer -> point
  float min_distance_m = 0.0F;  // distances at which the descriptor's scale is in the pyramid
  float max_distance_m = 0.0F;
  float angle_rad = 0.0F;     // orientation of the keypoint the descriptor was taken from
  Descriptor descriptor;      // the medoid of its observations
  KeyframeId reference;       // moves with this keyframe on corrections
  KeyframeId created_by;      // the keyframe that was inserted when it was made
  ObjectId object;            // what it is part of, if anything
  bool is_held_back = false;  // its object is not believed in: of no use, but still observed
  std::vector<PointObservation> observations;  // sorted by keyframe

  std::int32_t times_expected = 1;  // frames in which it should have been seen
  std::int32_t times_found = 1;     // frames in which it was

  bool IsActive() const { return state == PointState::kActive; }
};

// The one predicate that says whether a point may take part in bundle adjustment and place
// recognition, and in pose estimation wherever the background suffices.
inline bool IsUsable(const MapPoint& point) {
  return point.IsActive() && !point.is_held_back;
}

}  // namespace cslam
