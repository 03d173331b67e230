// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include <cstdint>

namespace cslam {

enum class Weave { kPlain, kStripes, kChecks, kMelange };

// Everything in which two people differ. Colours are BGR, 0 to 255.
struct PersonLook {
  double height_m = 1.75;
  double build = 1.0;  // width against the usual one
  cv::Scalar skin;
  cv::Scalar hair;
  cv::Scalar shirt;
  cv::Scalar shirt_second;  // of stripes and checks
  Weave weave = Weave::kPlain;
  double weave_period_m = 0.04;
  cv::Scalar trousers;
  cv::Scalar shoes;
  std::uint64_t seed = 0;  // of the details
};

// Neighbouring variants differ in shirt, trousers and weave at once.
PersonLook LookOf(int variant);

// Cloth with its pattern and soft folds; u runs around the body. CV_8UC3.
cv::Mat PaintShirt(const PersonLook& look, cv::Size size, double texels_per_m);
cv::Mat PaintTrousers(const PersonLook& look, cv::Size size, double texels_per_m);
cv::Mat PaintSkin(const PersonLook& look, cv::Size size);
cv::Mat PaintShoe(const PersonLook& look, cv::Size size);

// A head unrolled: the back at both sides, the face in the middle, crown on top, neck below.
cv::Mat PaintHead(const PersonLook& look, cv::Size size);

}  // namespace cslam
