// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/objects/depth_region.h"
#include "cslam/semantics/detection.h"

#include <vector>

namespace cslam {

// What each of the detections covers in the depth view of its frame, their boxes being in pixels
// of that view's camera. Those behind leave out what those in front cover. One region per
// detection, empty where depth shows nothing.
std::vector<DepthRegion> SegmentDetections(const DepthView& view,
                                           const std::vector<Detection>& detections,
                                           const RegionOptions& options);

}  // namespace cslam
