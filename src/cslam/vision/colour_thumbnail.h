// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

namespace cslam {

// A reduced colour image to know things again by: every k-th pixel of a CV_8UC3 image, half as many
// along each axis as the depth thumbnail has, in the middle of two by two of its pixels. Empty for
// an empty image.
cv::Mat MakeColourThumbnail(const cv::Mat& bgr);

// How many pixels of the depth thumbnail one of the colour thumbnail stands for, along each axis.
inline constexpr int kDepthPerColourPixel = 2;

}  // namespace cslam
