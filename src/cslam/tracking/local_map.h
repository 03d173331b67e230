// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map_view.h"
#include "cslam/tracking/tracker_options.h"
#include "cslam/vision/matching.h"
#include "cslam/vision/measurement_model.h"

#include <span>
#include <vector>

namespace cslam {

// The part of the map that a frame may see.
struct LocalMap {
  KeyframeId reference;               // shares most points with the frame
  std::vector<KeyframeId> keyframes;  // those that share points, then their neighbours
  std::vector<PointId> points;        // seen by the keyframes and not matched yet, in order
};

// matched: the points the frame has been matched with. fallback: where to start when none is.
LocalMap SelectLocalMap(const MapView& map, std::span<const PointId> matched, KeyframeId fallback,
                        const LocalMapOptions& options);

// A point of the local map that should be in view, and where.
struct ExpectedPoint {
  PointId point;
  ProjectionQuery query;
  bool is_held_back = false;  // by an object that is not believed in: IsUsable() is false
};

enum class HeldBack : std::uint8_t { kLeaveOut, kInclude };

// Those of the points that lie in front of the camera and inside the image, at a distance and an
// angle from which their descriptor can be recognised.
std::vector<ExpectedPoint> ExpectPoints(const MapView& map, std::span<const PointId> points,
                                        const Se3& T_world_camera, const Camera& camera,
                                        const ImageBounds& bounds, double baseline_m,
                                        const MeasurementModel& model,
                                        const LocalMapOptions& options,
                                        HeldBack held_back = HeldBack::kLeaveOut);

}  // namespace cslam
