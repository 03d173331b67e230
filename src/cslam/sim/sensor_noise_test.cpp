// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/sensor_noise.h"

#include "cslam/sim/simulated_sequence.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <cmath>

namespace cslam {
namespace {

cv::Mat NoisyWall(double depth_m, int width, std::uint64_t frame = 0) {
  const int height = width * 3 / 4;
  const cv::Mat wall(height, width, CV_32FC1, cv::Scalar(depth_m));
  return AddDepthNoise(wall, MakeSimulatedCamera(width, height), DepthNoiseOptions{}, 1, frame);
}

double DepthSigma(double depth_m, int width) {
  const cv::Mat noisy = NoisyWall(depth_m, width);
  double sum2 = 0.0;
  int count = 0;
  for (const float z : cv::Mat_<float>(noisy)) {
    if (z == 0.0F) continue;
    const double error_m = static_cast<double>(z) - depth_m;
    sum2 += error_m * error_m;
    ++count;
  }
  EXPECT_GT(count, 9 * noisy.rows * noisy.cols / 10) << depth_m << " m";
  return std::sqrt(sum2 / count);
}

TEST(AddDepthNoise, GrowsWithTheSquareOfDepth) {
  // Khoshelham and Elberink measured about 1.4 mm at 1 m, 6 mm at 2 m, 23 mm at 4 m.
  EXPECT_NEAR(DepthSigma(1.0, 320), 0.0019, 0.0007);
  EXPECT_NEAR(DepthSigma(2.0, 320), 0.0075, 0.0025);
  EXPECT_NEAR(DepthSigma(4.0, 320), 0.030, 0.010);
}

TEST(AddDepthNoise, OfTheD435iGrowsWithTheSquareOfDepth) {
  const auto sigma_m = [](double depth_m) {
    const cv::Mat wall(240, 320, CV_32FC1, cv::Scalar(depth_m));
    const cv::Mat noisy = AddDepthNoise(wall, MakeD435iCamera(320, 240), D435iDepthNoise(), 1, 0);
    EXPECT_EQ(cv::countNonZero(noisy), 240 * 320) << depth_m;
    return cv::norm(noisy, wall, cv::NORM_L2) / std::sqrt(240.0 * 320.0);
  };
  // z^2 / (615 px * 50 mm) * 0.08 px, and a little for the steps.
  for (const double depth_m : {1.0, 2.0, 4.0})
    EXPECT_NEAR(sigma_m(depth_m) / (depth_m * depth_m), 0.0026, 0.0006) << depth_m;
}

TEST(AddDepthNoise, OfTheD435iComesInMillimetresAndWideHoles) {
  cv::Mat depth_m(120, 160, CV_32FC1, cv::Scalar(3.0));
  depth_m.colRange(80, 120).setTo(cv::Scalar(1.0));
  const cv::Mat noisy = AddDepthNoise(depth_m, MakeD435iCamera(160, 120), D435iDepthNoise(), 1, 0);
  for (const float z : cv::Mat_<float>(noisy))
    EXPECT_NEAR(z * 1000.0F, std::round(z * 1000.0F), 1e-3F);
  EXPECT_EQ(cv::countNonZero(noisy.colRange(77, 79)), 0) << "hidden from the second camera";
  EXPECT_LT(cv::countNonZero(noisy.colRange(119, 121)), 120) << "most of 240 at the other edge";
  EXPECT_EQ(cv::countNonZero(noisy.colRange(130, 150)), 20 * 120);
}

TEST(AddDepthNoise, IsAsStrongInSmallImagesAsInLargeOnes) {
  EXPECT_NEAR(DepthSigma(2.0, 160) / DepthSigma(2.0, 640), 1.0, 0.15);
}

TEST(AddDepthNoise, DependsOnSeedAndFrameAlone) {
  EXPECT_EQ(cv::norm(NoisyWall(2.0, 160, 5), NoisyWall(2.0, 160, 5), cv::NORM_L1), 0.0);
  EXPECT_GT(cv::norm(NoisyWall(2.0, 160, 5), NoisyWall(2.0, 160, 6), cv::NORM_L1), 1.0);
}

TEST(AddDepthNoise, GivesNothingOutsideTheSensorsRange) {
  EXPECT_EQ(cv::countNonZero(NoisyWall(0.3, 160)), 0);
  EXPECT_EQ(cv::countNonZero(NoisyWall(6.0, 160)), 0);
}

// A near board in front of a far wall: columns 80 to 119 of 160.
cv::Mat BoardBeforeWall() {
  cv::Mat depth_m(120, 160, CV_32FC1, cv::Scalar(3.0));
  depth_m.colRange(80, 120).setTo(cv::Scalar(1.0));
  return depth_m;
}

TEST(AddDepthNoise, CastsTheProjectorsShadowToTheLeftOfNearThings) {
  const cv::Mat noisy =
      AddDepthNoise(BoardBeforeWall(), MakeSimulatedCamera(160, 120), DepthNoiseOptions{}, 1, 0);
  // Disparities 9.8 and 3.3 px at this width: a shadow of 6.5 px.
  EXPECT_EQ(cv::countNonZero(noisy.colRange(75, 79)), 0);
  EXPECT_EQ(cv::countNonZero(noisy.colRange(62, 70)), 8 * 120);
  EXPECT_EQ(cv::countNonZero(noisy.colRange(124, 134)), 10 * 120);
}

TEST(AddDepthNoise, LosesSomePixelsAtDepthSteps) {
  const cv::Mat noisy =
      AddDepthNoise(BoardBeforeWall(), MakeSimulatedCamera(160, 120), DepthNoiseOptions{}, 1, 0);
  const int left = cv::countNonZero(noisy.col(119));
  EXPECT_GT(left, 20);
  EXPECT_LT(left, 80);
}

TEST(AddDepthNoise, LosesSurfacesSeenAlmostEdgeOn) {
  const Camera camera = MakeSimulatedCamera(160, 120);
  // A floor 5 cm under the camera: seen at under 3 degrees.
  cv::Mat depth_m = cv::Mat::zeros(120, 160, CV_32FC1);
  for (int v = 62; v < 66; ++v)
    depth_m.row(v).setTo(cv::Scalar(0.05 * camera.fy / (v - camera.cy)));
  EXPECT_GT(cv::countNonZero(depth_m), 0);
  EXPECT_LT(cv::countNonZero(AddDepthNoise(depth_m, camera, DepthNoiseOptions{}, 1, 0)), 200);
}

}  // namespace
}  // namespace cslam
