// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

namespace cslam {

// A reduced depth image for later depth checks: every k-th pixel of a CV_32FC1 image in metres,
// at most 160 pixels wide, as CV_16UC1 millimetres. 0 = no reading or beyond 65 m.
cv::Mat MakeDepthThumbnail(const cv::Mat& depth_m);

// How many full-size pixels one thumbnail pixel stands for, along each axis.
int DepthThumbnailStep(int image_width);

}  // namespace cslam
