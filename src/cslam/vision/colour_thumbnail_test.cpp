// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/vision/colour_thumbnail.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

TEST(MakeColourThumbnail, KeepsEveryEighthPixelOfAVgaImage) {
  cv::Mat bgr(480, 640, CV_8UC3, cv::Scalar(1, 2, 3));
  bgr.at<cv::Vec3b>(3 * 8 + 4, 5 * 8 + 4) = {10, 20, 30};

  const cv::Mat small = MakeColourThumbnail(bgr);

  EXPECT_EQ(small.size(), cv::Size(80, 60));
  EXPECT_EQ(small.at<cv::Vec3b>(3, 5), cv::Vec3b(10, 20, 30));
  EXPECT_EQ(small.at<cv::Vec3b>(3, 6), cv::Vec3b(1, 2, 3));
}

TEST(MakeColourThumbnail, IsEmptyWithoutColours) {
  EXPECT_TRUE(MakeColourThumbnail(cv::Mat()).empty());
}

}  // namespace
}  // namespace cslam
