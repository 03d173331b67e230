// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/noise_fields.h"

#include <opencv2/imgproc.hpp>

#include <cmath>

namespace cslam {

cv::Mat SmoothNormal(cv::Size size, double spacing_px, Rng rng) {
  const auto cells = [&](int length) {
    return static_cast<int>(std::ceil(length / spacing_px)) + 2;
  };
  cv::Mat grid(cells(size.height), cells(size.width), CV_32FC1);
  const NormalTable table{Rng(rng.NextUint64())};
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.cols; ++c)
      grid.at<float>(r, c) = table.At(rng.NextUint64());
  }
  cv::Mat smooth;
  cv::resize(grid, smooth, size, 0.0, 0.0, cv::INTER_CUBIC);
  return smooth;
}

}  // namespace cslam
