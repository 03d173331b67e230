// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/actors/person_look.h"

#include "cslam/sim/paint_tools.h"
#include "cslam/util/random.h"

#include <opencv2/imgproc.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace cslam {
namespace {

constexpr std::uint64_t kLookPurpose = 0x6C6F6F6B;
constexpr std::uint64_t kShirtPurpose = 1;
constexpr std::uint64_t kTrousersPurpose = 2;
constexpr std::uint64_t kSkinPurpose = 3;
constexpr std::uint64_t kShoePurpose = 4;
constexpr std::uint64_t kHeadPurpose = 5;

template <std::size_t N>
const cv::Scalar& Pick(const std::array<cv::Scalar, N>& colors, int variant, int stride) {
  const int n = static_cast<int>(N);
  return colors[static_cast<std::size_t>(((variant * stride) % n + n) % n)];
}

// Light and dark along folds that run at a slant, as cloth hangs.
cv::Mat Folds(cv::Size size, double texels_per_m, double amplitude, Rng& rng) {
  cv::Mat folds = FractalNoise(size, {0.05 * texels_per_m, 0.16 * texels_per_m}, 3, rng);
  return amplitude * folds;
}

// How far towards the second colour the cloth is at a place (m), 0 or 1, soft at the seams.
double SecondAt(const PersonLook& look, double x_m, double y_m) {
  const auto wave = [&](double s_m) {
    const double phase = s_m / look.weave_period_m;
    return std::abs(phase - std::round(phase)) < 0.22 ? 1.0 : 0.0;
  };
  switch (look.weave) {
    case Weave::kStripes:
      return wave(y_m);
    case Weave::kChecks:
      return 0.5 * (wave(y_m) + wave(x_m));
    case Weave::kPlain:
    case Weave::kMelange:
      break;
  }
  return 0.0;
}

cv::Mat PaintCloth(const PersonLook& look, cv::Size size, double texels_per_m, bool has_pattern,
                   Rng rng) {
  const cv::Mat folds = Folds(size, texels_per_m, 20.0, rng);
  const double grain = has_pattern && look.weave == Weave::kMelange ? 16.0 : 6.0;
  const cv::Scalar first = has_pattern ? look.shirt : look.trousers;
  cv::Mat image(size, CV_8UC3);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const double second = has_pattern ? SecondAt(look, u / texels_per_m, v / texels_per_m) : 0.0;
      const double shade = 1.0 + static_cast<double>(folds.at<float>(v, u)) / 110.0;
      const double speck = grain * (rng.Uniform() + rng.Uniform() - 1.0);
      for (int c = 0; c < 3; ++c) {
        const double level = std::lerp(first[c], look.shirt_second[c], second);
        image.at<cv::Vec3b>(v, u)[c] = cv::saturate_cast<unsigned char>(level * shade + speck);
      }
    }
  }
  return image;
}

cv::Scalar Scaled(const cv::Scalar& color, double factor) {
  return {color[0] * factor, color[1] * factor, color[2] * factor};
}

cv::Point At(cv::Size size, double u, double v) {
  return {static_cast<int>(std::lround(u * size.width)),
          static_cast<int>(std::lround(v * size.height))};
}

cv::Size Radii(cv::Size size, double u, double v) {
  return {std::max(1, static_cast<int>(std::lround(u * size.width))),
          std::max(1, static_cast<int>(std::lround(v * size.height)))};
}

// Eyes, brows, nose, mouth and ears where a plain head has them.
void PaintFace(const PersonLook& look, cv::Mat image) {
  const cv::Size size = image.size();
  const auto ellipse = [&](double u, double v, double ru, double rv, const cv::Scalar& color) {
    cv::ellipse(image, At(size, u, v), Radii(size, ru, rv), 0.0, 0.0, 360.0, color, cv::FILLED,
                cv::LINE_AA);
  };
  for (const double side : {-1.0, 1.0}) {
    const double u = 0.5 + 0.062 * side;
    ellipse(u, 0.53, 0.034, 0.028, Scaled(look.skin, 0.78));
    ellipse(u, 0.535, 0.022, 0.014, {225, 228, 230});
    ellipse(u, 0.535, 0.010, 0.014, {45, 55, 70});
    ellipse(u, 0.485, 0.034, 0.010, Scaled(look.hair, 0.9));
    ellipse(0.5 + 0.25 * side, 0.56, 0.022, 0.055, Scaled(look.skin, 0.85));
    ellipse(0.5 + 0.014 * side, 0.655, 0.008, 0.009, Scaled(look.skin, 0.5));
  }
  ellipse(0.5, 0.645, 0.022, 0.022, Scaled(look.skin, 1.06));
  ellipse(0.5, 0.745, 0.042, 0.020,
          {0.62 * look.skin[0], 0.62 * look.skin[1], 0.85 * look.skin[2]});
  ellipse(0.5, 0.743, 0.042, 0.004, Scaled(look.skin, 0.4));
  ellipse(0.5, 0.795, 0.03, 0.008, Scaled(look.skin, 0.82));
}

}  // namespace

PersonLook LookOf(int variant) {
  static const std::array<cv::Scalar, 7> kShirts{{{60, 50, 165},
                                                  {175, 120, 50},
                                                  {205, 205, 200},
                                                  {70, 130, 60},
                                                  {60, 60, 65},
                                                  {60, 160, 205},
                                                  {120, 70, 110}}};
  static const std::array<cv::Scalar, 5> kTrousers{
      {{105, 70, 45}, {55, 52, 50}, {95, 125, 150}, {120, 110, 100}, {70, 45, 30}}};
  static const std::array<cv::Scalar, 5> kSkins{
      {{130, 158, 205}, {108, 138, 190}, {140, 170, 215}, {75, 105, 160}, {50, 72, 115}}};
  static const std::array<cv::Scalar, 5> kHairs{
      {{30, 40, 55}, {25, 25, 28}, {60, 95, 140}, {45, 62, 92}, {110, 110, 115}}};
  static const std::array<cv::Scalar, 4> kShoes{
      {{30, 32, 36}, {45, 70, 105}, {200, 200, 200}, {90, 55, 40}}};
  Rng rng(static_cast<std::uint64_t>(variant), 0, kLookPurpose);
  PersonLook look;
  look.height_m = rng.Uniform(1.62, 1.88);
  look.build = rng.Uniform(0.93, 1.12);
  look.skin = Pick(kSkins, variant, 1);
  look.hair = Pick(kHairs, variant, 2);
  look.shirt = Pick(kShirts, variant, 1);
  look.shirt_second = variant % 2 == 0 ? cv::Scalar(225, 225, 225) : Scaled(look.shirt, 0.45);
  if (cv::norm(look.shirt - look.shirt_second) < 80.0) look.shirt_second = {110, 60, 40};
  constexpr std::array<Weave, 4> kWeaves{Weave::kStripes, Weave::kChecks, Weave::kPlain,
                                         Weave::kMelange};
  look.weave = kWeaves[static_cast<std::size_t>((variant % 4 + 4) % 4)];
  look.weave_period_m = rng.Uniform(0.025, 0.06);
  look.trousers = Pick(kTrousers, variant, 1);
  look.shoes = Pick(kShoes, variant, 1);
  look.seed = rng.NextUint64();
  return look;
}

cv::Mat PaintShirt(const PersonLook& look, cv::Size size, double texels_per_m) {
  return PaintCloth(look, size, texels_per_m, true, Rng(look.seed, 0, kShirtPurpose));
}

cv::Mat PaintTrousers(const PersonLook& look, cv::Size size, double texels_per_m) {
  return PaintCloth(look, size, texels_per_m, false, Rng(look.seed, 0, kTrousersPurpose));
}

cv::Mat PaintSkin(const PersonLook& look, cv::Size size) {
  Rng rng(look.seed, 0, kSkinPurpose);
  const double spacing = 0.25 * size.width;
  return PaintNoise(FractalNoise(size, {spacing, spacing}, 4, rng), look.skin, 9.0, 2.0, rng);
}

cv::Mat PaintShoe(const PersonLook& look, cv::Size size) {
  Rng rng(look.seed, 0, kShoePurpose);
  const double spacing = 0.2 * size.width;
  return PaintNoise(FractalNoise(size, {spacing, spacing}, 4, rng), look.shoes, 12.0, 4.0, rng);
}

cv::Mat PaintHead(const PersonLook& look, cv::Size size) {
  Rng rng(look.seed, 0, kHeadPurpose);
  const double spacing = 0.12 * size.width;
  cv::Mat image =
      PaintNoise(FractalNoise(size, {spacing, spacing}, 4, rng), look.skin, 8.0, 2.0, rng);
  PaintFace(look, image);
  const cv::Mat strands = FractalNoise(size, {0.012 * size.width, 0.2 * size.height}, 3, rng);
  const cv::Mat hair = PaintNoise(strands, look.hair, 22.0, 5.0, rng);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      // The hairline: high over the face, low at the nape.
      const double from_front = std::abs(2.0 * (u + 0.5) / size.width - 1.0);
      const double low = from_front < 0.36 ? 0.34 : (from_front < 0.56 ? 0.52 : 0.78);
      const double fringe = 0.02 * static_cast<double>(strands.at<float>(v, u));
      if ((v + 0.5) / size.height < low + fringe)
        image.at<cv::Vec3b>(v, u) = hair.at<cv::Vec3b>(v, u);
    }
  }
  return image;
}

}  // namespace cslam
