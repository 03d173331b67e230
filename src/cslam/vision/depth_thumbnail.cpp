// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/vision/depth_thumbnail.h"

#include <algorithm>
#include <cmath>

namespace cslam {

int DepthThumbnailStep(int image_width) {
  constexpr int kMaxWidth = 160;
  return std::max(1, (image_width + kMaxWidth - 1) / kMaxWidth);
}

cv::Mat MakeDepthThumbnail(const cv::Mat& depth_m) {
  if (depth_m.empty()) return {};
  const int step = DepthThumbnailStep(depth_m.cols);
  cv::Mat thumbnail(depth_m.rows / step, depth_m.cols / step, CV_16UC1);
  for (int v = 0; v < thumbnail.rows; ++v) {
    const float* source = depth_m.ptr<float>(v * step + step / 2);
    auto* target = thumbnail.ptr<std::uint16_t>(v);
    for (int u = 0; u < thumbnail.cols; ++u) {
      const float mm = 1000.0F * source[u * step + step / 2];
      const bool is_valid = std::isfinite(mm) && mm > 0.0F && mm < 65535.0F;
      target[u] = is_valid ? static_cast<std::uint16_t>(std::lround(mm)) : std::uint16_t{0};
    }
  }
  return thumbnail;
}

}  // namespace cslam
