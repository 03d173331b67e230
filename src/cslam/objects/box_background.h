// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/objects/depth_region.h"

#include <opencv2/core/mat.hpp>

namespace cslam {

// Pixels of rect (thumbnail) that lie on planes seen around it: CV_8UC1 of the view's size, 255 on
// them. Empty if there are none, or if they would take all of the box: something flat, that lies on
// a table or hangs on a wall. Pixels set in excluded take no part. Deterministic.
cv::Mat BackgroundOfBox(const DepthView& view, const cv::Rect& rect, const cv::Mat& excluded,
                        const BoxBackgroundOptions& options);

}  // namespace cslam
