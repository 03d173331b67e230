// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/objects/depth_region.h"
#include "cslam/semantics/detection.h"

#include <vector>

namespace cslam {

struct SegmentedDetection {
  Detection detection;
  DepthRegion region;  // empty where depth shows nothing
};

// What each of the detections covers in the depth view of its frame, their boxes being in pixels
// of that view's camera. Those behind leave out what those in front cover. A detection of a mere
// piece, inside that of the whole thing by the same name, is left out; the order is kept.
std::vector<SegmentedDetection> SegmentDetections(const DepthView& view,
                                                  const std::vector<Detection>& detections,
                                                  const RegionOptions& options);

}  // namespace cslam
