// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/vision/orb_simd.h"

#include <opencv2/core/mat.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

// The pixel loops of the ORB extractor. Integer arithmetic only, so that every instruction set
// gives the same result. Images are CV_8UC1; outputs go to buffers that the extractor keeps
// between frames and are (re)allocated only when the size changes.
namespace cslam::orb {

// Circle of the orientation and of the descriptor, in level pixels.
inline constexpr int kPatchRadius = 15;

// Corners keep this distance (px) from the edges of their level: patch radius plus blur radius.
inline constexpr int kBorder = 18;

// The smallest image the kernels take: one group of 32 scores inside the frame, one row.
inline constexpr int kMinWidth = 2 * (kBorder - 2) + 32;
inline constexpr int kMinHeight = 2 * kBorder + 1;

// Bilinear downscaling of one fixed size to another, pixel centres at (x + 0.5, y + 0.5).
class Downscaler {
 public:
  Downscaler(cv::Size from, cv::Size to);
  void Run(const cv::Mat& image, Simd simd, cv::Mat& smaller);

 private:
  struct Tap {
    int index = 0;            // of the first of two neighbours
    std::uint8_t weight = 0;  // of the second one, in 1/128, 1 to 127
  };
  static constexpr std::size_t kPadding = 16;  // bytes a vector load may read beyond a row
  static std::vector<Tap> Taps(int from, int to);

  cv::Size from_, to_;
  std::vector<Tap> rows_, columns_;
  // columns_ for AVX2: where each group of 8 outputs starts; per output a pair of offsets from
  // there and a pair of weights.
  std::vector<int> starts_;
  std::vector<std::uint8_t> shuffles_, weights_;
  bool fits_shuffle_ = false;
  std::vector<std::uint8_t> row_;  // one vertically blended row, padded
};

// FAST-9/16. scores(y, x) = the largest threshold at which the pixel is still a corner, plus 1;
// 0 where it is none at `threshold`. Written only kBorder - 2 px and more from the edges.
void FastScores(const cv::Mat& image, int threshold, Simd simd, cv::Mat& scores);

struct Candidate {
  std::int16_t x = 0, y = 0;  // level px
  std::uint8_t score = 0;     // of FastScores()
};

// Scores smoothed by [1 2 1] / 4 both ways. Written only kBorder - 1 px and more from the edges.
void SmoothScores(const cv::Mat& scores, Simd simd, cv::Mat& smoothed);

// Corners whose smoothed score is the largest among 3x3 (of equals, the last), in reading order.
// Maxima of the raw score move more from frame to frame: 2 to 5 % fewer of them are matched.
std::vector<Candidate> LocalMaxima(const cv::Mat& scores, const cv::Mat& smoothed, Simd simd);

// 7x7 smoothing by the kernel [1 2 3 4 3 2 1] / 16 in both directions, standard deviation 1.58
// (a Gaussian of sigma 2 cut at 7 pixels has 1.64). The outermost 3 pixels are not written.
void Blur(const cv::Mat& image, Simd simd, cv::Mat& blurred);

// First moments of the disc of kPatchRadius around (x, y).
struct Moments {
  int x = 0, y = 0;
};
Moments DiscMoments(const cv::Mat& image, int x, int y, Simd simd);

}  // namespace cslam::orb
