// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include <vector>

namespace cslam {

// An image with its mip levels, repeated endlessly. Coordinates: (0, 0) top left, (1, 1) bottom
// right of one period. Colours are display values (sRGB-like), BGR, 0 to 255.
class Texture {
 public:
  // bgr: H x W, CV_8UC3, at least 1 x 1.
  explicit Texture(const cv::Mat& bgr);

  int width() const { return levels_.front().cols; }
  int height() const { return levels_.front().rows; }
  int num_levels() const { return static_cast<int>(levels_.size()); }

  // The mean colour over the parallelogram spanned by the two footprint vectors around uv (all in
  // texture periods): trilinear, with several taps along the longer vector.
  Eigen::Array3f Sample(const Eigen::Vector2f& uv, const Eigen::Vector2f& footprint_x,
                        const Eigen::Vector2f& footprint_y) const;

 private:
  Eigen::Array4f Bilinear(int level, const Eigen::Vector2f& uv) const;
  Eigen::Array4f Trilinear(float level, const Eigen::Vector2f& uv) const;

  std::vector<cv::Mat> levels_;  // CV_8UC4 (the fourth unused), halved until 1 x 1
};

}  // namespace cslam
