// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map_object.h"
#include "cslam/objects/depth_region.h"

#include <opencv2/core/mat.hpp>

namespace cslam {

// Of the pixels of bgr (H x W, CV_8UC3, as recorded) that region covers; all 0 without colours.
// Lens distortion is neglected.
ColourHistogram ColoursOf(const cv::Mat& bgr, const DepthRegion& region);
// The same of a mask (CV_8UC1 of any size, non-zero inside).
ColourHistogram ColoursOf(const cv::Mat& bgr, const cv::Mat& mask);

// How alike two histograms are: 0 to 1; 0.5 if one is empty.
double ColourLikeness(const ColourHistogram& a, const ColourHistogram& b);

// The pixels of bgr (CV_8UC3) whose hue, saturation and value each make up at least min_share of
// the colours, together with those of the neighbouring bins: CV_8UC1 of its size, 255 or 0.
cv::Mat PixelsOfColours(const cv::Mat& bgr, const ColourHistogram& colours, float min_share);

}  // namespace cslam
