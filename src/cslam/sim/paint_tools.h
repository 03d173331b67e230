// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/util/random.h"

#include <opencv2/core/mat.hpp>

#include <string>

namespace cslam {

// The brushes of the texture painters. Images are CV_8UC3, BGR; colours are BGR, 0 to 255.

// Sum of smooth random fields: the first with the given spacing, each next half as wide and half
// as strong. size, CV_32FC1, values mostly within -1 to 1.
cv::Mat FractalNoise(cv::Size size, cv::Size2d spacing_px, int octaves, Rng& rng);

// A plane of one colour, lighter and darker by amplitude (grey levels) times the noise, plus a
// fine grain of the given sigma (grey levels).
cv::Mat PaintNoise(const cv::Mat& noise, const cv::Scalar& color, double amplitude, double grain,
                   Rng& rng);

// A random colour. saturation and value from 0 to 1.
cv::Scalar RandomColor(Rng& rng, double saturation, double value);

cv::Scalar Shift(const cv::Scalar& color, double levels);

// Random letters that look like words.
std::string RandomWords(int num_letters, Rng& rng);

// An integer in [low, high].
int RandomInt(Rng& rng, int low, int high);

// image with a rectangle of text lines painted over it.
struct TextBlock {
  cv::Rect area;
  double line_px = 8.0;  // distance between lines
  cv::Scalar color;
  bool ragged = true;  // lines of different lengths
};
cv::Mat WithText(cv::Mat image, const TextBlock& block, Rng& rng);

// image with one line of words across the whole width of area.
cv::Mat WithHeadline(cv::Mat image, const cv::Rect& area, const cv::Scalar& color, Rng& rng);

// size_m in texels, at least 4 x 4.
cv::Size TexelSize(double width_m, double height_m, double texels_per_m);

}  // namespace cslam
