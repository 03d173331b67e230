// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/vision/orb_kernels.h"

#include "cslam/util/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

namespace cslam::orb {
namespace {

// Noise with steps, so that there are corners of all strengths.
cv::Mat RandomImage(int width, int height, std::uint64_t seed) {
  Rng rng(seed);
  cv::Mat image(height, width, CV_8UC1);
  const int noise = 3 + static_cast<int>(rng.Index(60));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int step = (x / 9 + y / 13) % 2 == 0 ? 60 : 140;
      const auto value = step + rng.Uniform(-noise, noise);
      image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0));
    }
  }
  return image;
}

// The same part of two images, byte by byte.
bool AreEqual(const cv::Mat& a, const cv::Mat& b, int margin) {
  if (a.size() != b.size()) return false;
  for (int y = margin; y < a.rows - margin; ++y) {
    for (int x = margin; x < a.cols - margin; ++x) {
      if (a.at<std::uint8_t>(y, x) != b.at<std::uint8_t>(y, x)) return false;
    }
  }
  return true;
}

// By definition: 9 neighbours on the ring all brighter or all darker by more than the threshold.
bool IsFastCorner(const cv::Mat& image, int x, int y, int threshold) {
  constexpr std::array<std::array<int, 2>, 16> kRing = {{{0, -3},
                                                         {1, -3},
                                                         {2, -2},
                                                         {3, -1},
                                                         {3, 0},
                                                         {3, 1},
                                                         {2, 2},
                                                         {1, 3},
                                                         {0, 3},
                                                         {-1, 3},
                                                         {-2, 2},
                                                         {-3, 1},
                                                         {-3, 0},
                                                         {-3, -1},
                                                         {-2, -2},
                                                         {-1, -3}}};
  for (std::size_t start = 0; start < 16; ++start) {
    bool is_bright = true;
    bool is_dark = true;
    for (std::size_t i = 0; i < 9; ++i) {
      const auto [dx, dy] = kRing[(start + i) % 16];
      const int difference = image.at<std::uint8_t>(y + dy, x + dx) - image.at<std::uint8_t>(y, x);
      is_bright = is_bright && difference > threshold;
      is_dark = is_dark && difference < -threshold;
    }
    if (is_bright || is_dark) return true;
  }
  return false;
}

std::vector<Simd> AllSimd() {
  std::vector<Simd> all = {Simd::kBaseline};
  if (BestSimd() != Simd::kBaseline) all.push_back(BestSimd());
  return all;
}

constexpr std::array<std::array<int, 2>, 4> kSizes = {{{640, 96}, {131, 77}, {66, 41}, {97, 64}}};

TEST(FastScores, AreTheLargestThresholdOfACornerPlusOne) {
  const cv::Mat image = RandomImage(90, 60, 1);
  cv::Mat scores;
  for (const Simd simd : AllSimd()) {
    FastScores(image, 10, simd, scores);
    for (int y = kBorder; y < image.rows - kBorder; ++y) {
      for (int x = kBorder; x < image.cols - kBorder; ++x) {
        const int score = scores.at<std::uint8_t>(y, x);
        if (score == 0) {
          ASSERT_FALSE(IsFastCorner(image, x, y, 10)) << x << ' ' << y;
          continue;
        }
        ASSERT_GT(score, 10);
        ASSERT_TRUE(IsFastCorner(image, x, y, score - 1)) << x << ' ' << y;
        ASSERT_FALSE(IsFastCorner(image, x, y, score)) << x << ' ' << y;
      }
    }
  }
}

TEST(Kernels, GiveTheSameBytesOnEveryInstructionSet) {
  for (const auto& [width, height] : kSizes) {
    const cv::Mat image = RandomImage(width, height, static_cast<std::uint64_t>(width));
    std::array<cv::Mat, 2> scores, smoothed, blurred, smaller;
    std::array<std::vector<Candidate>, 2> maxima;
    const std::array<Simd, 2> simd = {Simd::kBaseline, BestSimd()};
    for (std::size_t i = 0; i < 2; ++i) {
      FastScores(image, 7, simd[i], scores[i]);
      SmoothScores(scores[i], simd[i], smoothed[i]);
      maxima[i] = LocalMaxima(scores[i], smoothed[i], simd[i]);
      Blur(image, simd[i], blurred[i]);
      Downscaler({width, height}, {width * 5 / 6, height * 5 / 6}).Run(image, simd[i], smaller[i]);
    }
    EXPECT_TRUE(AreEqual(scores[0], scores[1], kBorder - 2)) << width;
    EXPECT_TRUE(AreEqual(smoothed[0], smoothed[1], kBorder - 1)) << width;
    EXPECT_TRUE(AreEqual(blurred[0], blurred[1], 3)) << width;
    EXPECT_TRUE(AreEqual(smaller[0], smaller[1], 0)) << width;
    EXPECT_TRUE(std::ranges::equal(maxima[0], maxima[1], [](const auto& a, const auto& b) {
      return std::tuple(a.x, a.y, a.score) == std::tuple(b.x, b.y, b.score);
    })) << width;
    const Moments a = DiscMoments(image, kBorder, height - kBorder - 1, simd[0]);
    const Moments b = DiscMoments(image, kBorder, height - kBorder - 1, simd[1]);
    EXPECT_EQ(std::tuple(a.x, a.y), std::tuple(b.x, b.y)) << width;
  }
}

TEST(LocalMaxima, KeepOnlyTheLastOfEqualNeighbours) {
  cv::Mat scores(60, 80, CV_8UC1, cv::Scalar(0));
  scores.at<std::uint8_t>(30, 40) = 50;
  scores.at<std::uint8_t>(30, 41) = 50;
  scores.at<std::uint8_t>(31, 40) = 50;
  scores.at<std::uint8_t>(25, 30) = 20;
  for (const Simd simd : AllSimd()) {
    const std::vector<Candidate> maxima = LocalMaxima(scores, scores, simd);
    ASSERT_EQ(maxima.size(), 2U);
    EXPECT_EQ(std::tuple(maxima[0].x, maxima[0].y, maxima[0].score), std::tuple(30, 25, 20));
    EXPECT_EQ(std::tuple(maxima[1].x, maxima[1].y, maxima[1].score), std::tuple(40, 31, 50));
  }
}

TEST(Blur, WeighsNeighboursByTheProductOfTriangles) {
  cv::Mat image(40, 70, CV_8UC1, cv::Scalar(0));
  image.at<std::uint8_t>(20, 30) = 255;
  cv::Mat blurred;
  for (const Simd simd : AllSimd()) {
    Blur(image, simd, blurred);
    for (int y = 3; y < 37; ++y) {
      for (int x = 3; x < 67; ++x) {
        const int weight = std::max(0, 4 - std::abs(x - 30)) * std::max(0, 4 - std::abs(y - 20));
        ASSERT_EQ(blurred.at<std::uint8_t>(y, x), (255 * weight + 128) / 256) << x << ' ' << y;
      }
    }
  }
}

TEST(Blur, LeavesAWhiteImageWhite) {
  const cv::Mat image(40, 70, CV_8UC1, cv::Scalar(255));
  cv::Mat blurred;
  for (const Simd simd : AllSimd()) {
    Blur(image, simd, blurred);
    EXPECT_TRUE(AreEqual(image, blurred, 3));
  }
}

// A ramp tells where each pixel was sampled.
TEST(Downscaler, SamplesAtPixelCentres) {
  cv::Mat image(120, 200, CV_8UC1);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(x + y / 4);
    }
  }
  cv::Mat smaller;
  for (const Simd simd : AllSimd()) {
    Downscaler(image.size(), {167, 100}).Run(image, simd, smaller);
    for (int y = 1; y < 99; ++y) {
      for (int x = 1; x < 166; ++x) {
        const double expected = (x + 0.5) * 200 / 167 - 0.5 + ((y + 0.5) * 1.2 - 0.5) / 4;
        ASSERT_NEAR(smaller.at<std::uint8_t>(y, x), expected, 1.5) << x << ' ' << y;
      }
    }
  }
}

TEST(Downscaler, TakesAnyFactorUpToThree) {
  for (const auto& [width, height] : {std::tuple(200, 120), std::tuple(111, 66), {67, 41}}) {
    const cv::Mat image = RandomImage(201, 123, 3);
    std::array<cv::Mat, 2> smaller;
    Downscaler scaler(image.size(), {width, height});
    scaler.Run(image, Simd::kBaseline, smaller[0]);
    scaler.Run(image, BestSimd(), smaller[1]);
    EXPECT_TRUE(AreEqual(smaller[0], smaller[1], 0)) << width;
  }
}

TEST(DiscMoments, AreTheSumsOverTheDisc) {
  const cv::Mat image = RandomImage(70, 60, 5);
  Moments expected;
  for (int y = -15; y <= 15; ++y) {
    for (int x = -15; x <= 15; ++x) {
      if (std::hypot(x, y) > 15.5) continue;
      expected.x += x * image.at<std::uint8_t>(30 + y, 33 + x);
      expected.y += y * image.at<std::uint8_t>(30 + y, 33 + x);
    }
  }
  for (const Simd simd : AllSimd()) {
    const Moments moments = DiscMoments(image, 33, 30, simd);
    EXPECT_EQ(moments.x, expected.x);
    EXPECT_EQ(moments.y, expected.y);
  }
}

TEST(DiscMoments, DoNotOverflowOnTheBrightestHalves) {
  for (const Simd simd : AllSimd()) {
    cv::Mat image(60, 60, CV_8UC1, cv::Scalar(0));
    image.rowRange(31, 60).setTo(255);
    const Moments below = DiscMoments(image, 30, 30, simd);
    cv::Mat flipped(60, 60, CV_8UC1, cv::Scalar(0));
    flipped.rowRange(0, 30).setTo(255);
    const Moments above = DiscMoments(flipped, 30, 30, simd);
    EXPECT_GT(below.y, 255 * 15 * 100);
    EXPECT_EQ(above.y, -below.y);
    EXPECT_EQ(above.x, 0);
  }
}

}  // namespace
}  // namespace cslam::orb
