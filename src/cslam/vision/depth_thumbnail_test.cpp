// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/vision/depth_thumbnail.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <cstdint>
#include <limits>

namespace cslam {
namespace {

TEST(MakeDepthThumbnail, KeepsEveryFourthPixelOfAVgaImageInMillimetres) {
  cv::Mat depth_m(480, 640, CV_32FC1);
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u)
      depth_m.at<float>(v, u) = 0.001F * static_cast<float>(1 + u + 8 * v);
  }
  const cv::Mat small = MakeDepthThumbnail(depth_m);
  ASSERT_EQ(small.type(), CV_16UC1);
  ASSERT_EQ(small.size(), cv::Size(160, 120));
  EXPECT_EQ(small.at<std::uint16_t>(0, 0), 1 + 2 + 8 * 2) << "the middle of its 4 x 4 pixels";
  EXPECT_EQ(small.at<std::uint16_t>(30, 50), 1 + (50 * 4 + 2) + 8 * (30 * 4 + 2));
}

TEST(MakeDepthThumbnail, SaysNoReadingWhereThereIsNone) {
  for (const float depth : {0.0F, -1.0F, 70.0F, std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::infinity()}) {
    const cv::Mat depth_m(4, 4, CV_32FC1, cv::Scalar(static_cast<double>(depth)));
    EXPECT_EQ(cv::countNonZero(MakeDepthThumbnail(depth_m)), 0) << depth;
  }
}

TEST(MakeDepthThumbnail, IsEmptyWithoutDepth) {
  EXPECT_TRUE(MakeDepthThumbnail(cv::Mat()).empty());
}

TEST(DepthThumbnailStep, MakesAtMost160Columns) {
  EXPECT_EQ(DepthThumbnailStep(640), 4);
  EXPECT_EQ(DepthThumbnailStep(641), 5);
  EXPECT_EQ(DepthThumbnailStep(320), 2);
  EXPECT_EQ(DepthThumbnailStep(100), 1);
}

}  // namespace
}  // namespace cslam
