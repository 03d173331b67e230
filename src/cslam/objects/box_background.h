// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/objects/depth_region.h"

#include <opencv2/core/mat.hpp>

namespace cslam {

struct BoxBackground {
  cv::Mat mask;  // CV_8UC1 of the view's size, 255 on the planes; empty: nothing to leave out
  bool is_flat = false;  // the planes hold all of the box: what lies on a table or hangs on a wall
  bool is_on_wall = false;  // ... on one that stands upright, if the camera does on the whole
};

// Which pixels of rect (thumbnail) lie on planes seen around it. Pixels set in excluded take no
// part. Deterministic.
BoxBackground FindBoxBackground(const DepthView& view, const cv::Rect& rect,
                                const cv::Mat& excluded, const BoxBackgroundOptions& options);

}  // namespace cslam
