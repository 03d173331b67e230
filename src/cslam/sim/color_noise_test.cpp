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
  EXPECT_NEAR(sigma[1], 1.3, 0.4);
  cv::meanStdDev(noisy(cv::Rect(0, 0, 10, 10)), mean, sigma);
  EXPECT_NEAR(mean[2], 150.0 * 0.89, 2.0);
}

TEST(AddColorNoise, DependsOnSeedAndFrameAlone) {
  const cv::Mat grey(48, 64, CV_8UC3, cv::Scalar::all(150));
  const cv::Mat one = AddColorNoise(grey, ColorNoiseOptions{}, 3, 7);
  EXPECT_EQ(cv::norm(one, AddColorNoise(grey, ColorNoiseOptions{}, 3, 7), cv::NORM_L1), 0.0);
  EXPECT_GT(cv::norm(one, AddColorNoise(grey, ColorNoiseOptions{}, 4, 7), cv::NORM_L1), 0.0);
}

TEST(AddColorNoise, IsRelativelyStrongerInTheDark) {
  const cv::Mat grey(240, 320, CV_8UC3, cv::Scalar::all(150));
  const auto relative = [&](double exposure) {
    ColorNoiseOptions options;
    options.exposure = exposure;
    cv::Scalar mean;
    cv::Scalar sigma;
    cv::meanStdDev(AddColorNoise(grey, options, 1, 0)(cv::Rect(140, 100, 40, 40)), mean, sigma);
    return sigma[1] / mean[1];
  };
  EXPECT_GT(relative(0.05), 2.5 * relative(1.0));
}

TEST(AddColorNoise, OfTheD435iIsSoftAndSmooth) {
  cv::Mat step(240, 320, CV_8UC3, cv::Scalar::all(50));
  step.colRange(160, 320).setTo(cv::Scalar::all(200));
  const cv::Mat noisy = AddColorNoise(step, D435iColorNoise(), 1, 0);
  EXPECT_NEAR(noisy.at<cv::Vec3b>(120, 159)[1], 75, 30);
  cv::Mat left;
  cv::Mat right;
  noisy(cv::Rect(100, 100, 40, 40)).convertTo(left, CV_32FC3);
  noisy(cv::Rect(101, 100, 40, 40)).convertTo(right, CV_32FC3);
  cv::Scalar mean;
  cv::Scalar sigma;
  cv::Scalar difference;
  cv::meanStdDev(left, mean, sigma);
  cv::meanStdDev(left - right, mean, difference);
  EXPECT_GT(sigma[0], 0.5);
  EXPECT_LT(difference[0], 1.2 * sigma[0]) << "sqrt(2) of it if neighbours were independent";
}

TEST(Expose, ChangesLightAndNothingElse) {
  const cv::Mat grey(4, 4, CV_8UC3, cv::Scalar::all(150));
  EXPECT_EQ(cv::norm(Expose(grey, 1.0), grey, cv::NORM_L1), 0.0);
  // A quarter of the light, displayed with a gamma of 2.2.
  EXPECT_EQ(Expose(grey, 0.25).at<cv::Vec3b>(1, 1), cv::Vec3b(80, 80, 80));
}

}  // namespace
}  // namespace cslam
