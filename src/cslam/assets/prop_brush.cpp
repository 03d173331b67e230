// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/prop_brush.h"

#include "cslam/sim/paint_tools.h"
#include "cslam/sim/surface_paint.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>

namespace cslam {

cv::Size PropBrush::Texels(double width_m, double height_m) const {
  return TexelSize(width_m, height_m, texels_per_m_);
}

int PropBrush::Wood() {
  const std::array<cv::Scalar, 4> tones{cv::Scalar(70, 112, 156), cv::Scalar(104, 158, 196),
                                        cv::Scalar(44, 66, 98), cv::Scalar(178, 192, 204)};
  return Wood(tones[rng_.Index(tones.size())]);
}

int PropBrush::Wood(const cv::Scalar& color_bgr) {
  return scene_.AddSurface(PaintWood(Texels(kPatchM, kPatchM), texels_per_m_, color_bgr, NextRng()),
                           kPatchM, kPatchM);
}

int PropBrush::Fabric(double saturation, double value) {
  return Fabric(RandomColor(rng_, saturation, value));
}

int PropBrush::Fabric(const cv::Scalar& color_bgr) {
  return scene_.AddSurface(
      PaintFabric(Texels(kPatchM, kPatchM), texels_per_m_, color_bgr, NextRng()), kPatchM, kPatchM);
}

int PropBrush::RichFabric() {
  return scene_.AddSurface(PaintRichFabric(Texels(kRichM, kRichM), texels_per_m_, NextRng()),
                           kRichM, kRichM);
}

int PropBrush::Plain(const cv::Scalar& color_bgr) {
  return scene_.AddSurface(PaintPlain(Texels(kPatchM, kPatchM), color_bgr, NextRng()), kPatchM,
                           kPatchM);
}

int PropBrush::Fur(const cv::Scalar& color_bgr) {
  const cv::Size size = Texels(kPatchM, kPatchM);
  const cv::Mat noise = FractalNoise(size, {0.04 * texels_per_m_, 0.06 * texels_per_m_}, 5, rng_);
  return scene_.AddSurface(PaintNoise(noise, color_bgr, 26.0, 8.0, rng_), kPatchM, kPatchM);
}

cv::Mat PaintRichFabric(cv::Size size, double texels_per_m, Rng rng) {
  // Shades of one colour: in many colours, detectors take an armchair for a cake.
  const cv::Scalar ground = RandomColor(rng, rng.Uniform(0.25, 0.5), rng.Uniform(0.34, 0.46));
  cv::Mat image = PaintNoise(FractalNoise(size, {0.2 * texels_per_m, 0.2 * texels_per_m}, 6, rng),
                             ground, 20.0, 6.0, rng);
  const double area_m2 = size.area() / (texels_per_m * texels_per_m);
  constexpr double kMotifsPerM2 = 700.0;
  const int motifs = static_cast<int>(kMotifsPerM2 * area_m2);
  for (int i = 0; i < motifs; ++i) {
    const cv::Point at(RandomInt(rng, 0, size.width), RandomInt(rng, 0, size.height));
    const double size_m = rng.Uniform(0.004, 0.02) * (i % 9 == 0 ? 2.0 : 1.0);
    const int length = std::max(2, static_cast<int>(size_m * texels_per_m));
    const cv::Scalar color = Shift(ground, rng.Uniform(-55.0, 60.0));
    const int petals = RandomInt(rng, 1, 6);
    const double turn_deg = rng.Uniform(0.0, 360.0);
    for (int p = 0; p < petals; ++p) {  // one petal is a leaf, several are a flower
      const double angle_deg = turn_deg + 360.0 * p / petals + rng.Uniform(-12.0, 12.0);
      const double angle_rad = angle_deg * CV_PI / 180.0;
      const cv::Point centre = at + cv::Point(static_cast<int>(0.8 * length * std::cos(angle_rad)),
                                              static_cast<int>(0.8 * length * std::sin(angle_rad)));
      cv::ellipse(image, centre, {length, std::max(1, length / 3)}, angle_deg, 0.0, 360.0,
                  Shift(color, rng.Uniform(-12.0, 12.0)), cv::FILLED, cv::LINE_AA);
    }
    cv::circle(image, at, std::max(1, length / 3), Shift(color, rng.Uniform(-60.0, 60.0)),
               cv::FILLED, cv::LINE_AA);
  }
  return image;
}

cv::Mat PaintLitScreen(cv::Size size, Rng rng) {
  const cv::Scalar deep(rng.Uniform(70.0, 110.0), rng.Uniform(40.0, 64.0), rng.Uniform(14.0, 34.0));
  cv::Mat image(size, CV_8UC3);
  for (int y = 0; y < size.height; ++y)  // lighter towards the top, as screens at rest look
    image.row(y).setTo(Shift(deep, 40.0 * (1.0 - static_cast<double>(y) / size.height)));
  const auto part = [&](double x, double y, double width, double height) {
    return cv::Rect(static_cast<int>(x * size.width), static_cast<int>(y * size.height),
                    std::max(2, static_cast<int>(width * size.width)),
                    std::max(2, static_cast<int>(height * size.height)));
  };
  for (int i = 0; i < 2; ++i) {  // two windows with text
    const cv::Rect window = part(rng.Uniform(0.08, 0.2) + 0.4 * i, rng.Uniform(0.1, 0.3),
                                 rng.Uniform(0.3, 0.38), rng.Uniform(0.35, 0.5));
    cv::rectangle(image, window, Shift(deep, i == 0 ? 14.0 : 95.0), cv::FILLED);
    cv::rectangle(image, {window.x, window.y, window.width, std::max(2, window.height / 12)},
                  Shift(deep, 70.0), cv::FILLED);
    const cv::Rect text(window.x + window.width / 12, window.y + window.height / 6,
                        5 * window.width / 6, 3 * window.height / 4);
    image = WithText(
        image, {text, std::max(5.0, text.height / 11.0), Shift(deep, 150.0 - 190.0 * i)}, rng);
  }
  cv::rectangle(image, part(0.0, 0.94, 1.0, 0.06), Shift(deep, -30.0), cv::FILLED);
  for (int i = 0; i < 7; ++i)  // icons
    cv::rectangle(image, part(0.01 + 0.04 * i, 0.95, 0.025, 0.04), RandomColor(rng, 0.5, 0.7),
                  cv::FILLED);
  return image;
}

}  // namespace cslam
