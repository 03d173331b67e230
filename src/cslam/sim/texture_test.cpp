// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/texture.h"

#include "cslam/util/check.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace cslam {
namespace {

const Eigen::Vector2f kNoFootprint(0.0F, 0.0F);

cv::Mat Checkerboard(int size) {
  cv::Mat image(size, size, CV_8UC3);
  for (int v = 0; v < size; ++v) {
    for (int u = 0; u < size; ++u)
      image.at<cv::Vec3b>(v, u) = (u + v) % 2 == 0 ? cv::Vec3b(200, 200, 200) : cv::Vec3b(0, 0, 0);
  }
  return image;
}

TEST(Texture, GivesTheTexelAtItsCentreWhenSeenFromNear) {
  cv::Mat image(2, 2, CV_8UC3, cv::Scalar(0, 0, 0));
  image.at<cv::Vec3b>(1, 0) = {10, 20, 30};
  const Texture texture(image);
  const Eigen::Array3f color = texture.Sample({0.25F, 0.75F}, {0.001F, 0.0F}, {0.0F, 0.001F});
  EXPECT_NEAR(color[0], 10.0F, 1e-4F);
  EXPECT_NEAR(color[1], 20.0F, 1e-4F);
  EXPECT_NEAR(color[2], 30.0F, 1e-4F);
}

TEST(Texture, GivesTheMeanWhenTheFootprintIsAsLargeAsTheImage) {
  const Texture texture(Checkerboard(64));
  for (const float u : {0.0F, 0.3F, 0.61F}) {
    EXPECT_NEAR(texture.Sample({u, 0.2F}, {1.0F, 0.0F}, {0.0F, 1.0F})[0], 100.0F, 1.0F);
  }
}

TEST(Texture, KeepsDetailAcrossAnElongatedFootprint) {
  cv::Mat stripes(64, 64, CV_8UC3, cv::Scalar(0, 0, 0));
  stripes.colRange(0, 32).setTo(cv::Scalar(200, 200, 200));
  const Texture texture(stripes);
  // Long along the stripes (v), short across (u): the border stays sharp.
  const Eigen::Vector2f across(1.0F / 64.0F, 0.0F);
  const Eigen::Vector2f along(0.0F, 4.0F / 64.0F);
  EXPECT_GT(texture.Sample({0.45F, 0.5F}, across, along)[0], 190.0F);
  EXPECT_LT(texture.Sample({0.55F, 0.5F}, across, along)[0], 10.0F);
}

TEST(Texture, RepeatsOutsideTheUnitSquare) {
  const Texture texture(Checkerboard(4));
  const Eigen::Array3f inside = texture.Sample({0.3F, 0.6F}, kNoFootprint, kNoFootprint);
  const Eigen::Array3f outside = texture.Sample({-1.7F, 3.6F}, kNoFootprint, kNoFootprint);
  EXPECT_TRUE(inside.isApprox(outside, 1e-3F)) << inside << " against " << outside;
}

TEST(Texture, RefusesAnythingButColor) {
  EXPECT_THROW(Texture(cv::Mat(4, 4, CV_8UC1)), InternalError);
  EXPECT_THROW(Texture(cv::Mat()), InternalError);
}

}  // namespace
}  // namespace cslam
