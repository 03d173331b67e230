// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/objects/depth_region.h"

#include <opencv2/core/mat.hpp>

namespace cslam {

// Which pixels of rect (thumbnail) belong to what reaches into the box from its left or right and
// hides part of the thing: surfaces that go on beyond the box's edge, and end inside it before
// something farther. CV_8UC1 of the view's size, 255 on them; empty: none. Edges of the picture
// count for nothing, for what is beyond them is not known.
cv::Mat FindBoxOccluders(const DepthView& view, const cv::Rect& rect, double step_ratio,
                         const BoxOccluderOptions& options);

}  // namespace cslam
