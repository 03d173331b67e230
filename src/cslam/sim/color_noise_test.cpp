// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/color_noise.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace cslam {
namespace {

TEST(AddColorNoise, DarkensTheCornersAndKeepsTheMeanInTheMiddle) {
  const cv::Mat grey(240, 320, CV_8UC3, cv::Scalar::all(150));
  const cv::Mat noisy = AddColorNoise(grey, ColorNoiseOptions{}, 1, 0);
  cv::Scalar mean;
  cv::Scalar sigma;
  cv::meanStdDev(noisy(cv::Rect(150, 110, 20, 20)), mean, sigma);
  EXPECT_NEAR(mean[0], 150.0, 0.6);
  EXPECT_NEAR(sigma[1], 2.0, 0.4);
  cv::meanStdDev(noisy(cv::Rect(0, 0, 10, 10)), mean, sigma);
  EXPECT_NEAR(mean[2], 150.0 * 0.89, 2.0);
}

TEST(AddColorNoise, DependsOnSeedAndFrameAlone) {
  const cv::Mat grey(48, 64, CV_8UC3, cv::Scalar::all(150));
  const cv::Mat one = AddColorNoise(grey, ColorNoiseOptions{}, 3, 7);
  EXPECT_EQ(cv::norm(one, AddColorNoise(grey, ColorNoiseOptions{}, 3, 7), cv::NORM_L1), 0.0);
  EXPECT_GT(cv::norm(one, AddColorNoise(grey, ColorNoiseOptions{}, 4, 7), cv::NORM_L1), 0.0);
}

}  // namespace
}  // namespace cslam
