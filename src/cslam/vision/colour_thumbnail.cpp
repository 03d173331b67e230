// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/vision/colour_thumbnail.h"

#include "cslam/vision/depth_thumbnail.h"

namespace cslam {

cv::Mat MakeColourThumbnail(const cv::Mat& bgr) {
  if (bgr.empty()) return {};
  const int step = kDepthPerColourPixel * DepthThumbnailStep(bgr.cols);
  cv::Mat thumbnail(bgr.rows / step, bgr.cols / step, CV_8UC3);
  for (int v = 0; v < thumbnail.rows; ++v) {
    for (int u = 0; u < thumbnail.cols; ++u)
      thumbnail.at<cv::Vec3b>(v, u) = bgr.at<cv::Vec3b>(v * step + step / 2, u * step + step / 2);
  }
  return thumbnail;
}

}  // namespace cslam
