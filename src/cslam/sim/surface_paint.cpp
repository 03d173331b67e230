// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/surface_paint.h"

#include "cslam/sim/paint_tools.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace cslam {
namespace {

int Texels(double length_m, double texels_per_m) {
  return std::max(1, static_cast<int>(std::lround(length_m * texels_per_m)));
}

cv::Size2d Isotropic(double spacing_px) {
  return {spacing_px, spacing_px};
}

// Small dark and light spots, as years leave them.
cv::Mat WithScuffs(cv::Mat image, int count, double size_px, double strength, Rng& rng) {
  for (int i = 0; i < count; ++i) {
    const cv::Point at(RandomInt(rng, 0, image.cols - 1), RandomInt(rng, 0, image.rows - 1));
    const cv::Vec3b here = image.at<cv::Vec3b>(at);
    const cv::Scalar color =
        Shift(cv::Scalar(here[0], here[1], here[2]), strength * rng.Uniform(-1.0, 0.5));
    const cv::Size axes(std::max(1, static_cast<int>(size_px * rng.Uniform(0.3, 1.5))),
                        std::max(1, static_cast<int>(size_px * rng.Uniform(0.2, 0.7))));
    cv::ellipse(image, at, axes, rng.Uniform(0.0, 180.0), 0.0, 360.0, color, cv::FILLED,
                cv::LINE_AA);
  }
  return image;
}

// A copy of pattern-free wood with the grain along x.
cv::Mat WoodGrain(cv::Size size, double texels_per_m, const cv::Scalar& color, Rng& rng) {
  const cv::Mat noise =
      FractalNoise(size, {0.5 * texels_per_m, 0.02 * texels_per_m}, 4, rng) +
      0.4 * FractalNoise(size, {0.08 * texels_per_m, 0.006 * texels_per_m}, 2, rng);
  return PaintNoise(noise, color, 26.0, 3.0, rng);
}

}  // namespace

cv::Mat PaintPlaster(cv::Size size, double texels_per_m, const cv::Scalar& color, Rng rng) {
  const cv::Mat noise = FractalNoise(size, Isotropic(0.5 * texels_per_m), 6, rng) +
                        0.5 * FractalNoise(size, Isotropic(0.015 * texels_per_m), 2, rng);
  const cv::Mat image = PaintNoise(noise, color, 9.0, 3.0, rng);
  const double area_m2 = size.area() / (texels_per_m * texels_per_m);
  return WithScuffs(image, static_cast<int>(30.0 * area_m2), 0.008 * texels_per_m, 45.0, rng);
}

cv::Mat PaintWallpaper(cv::Size size, double texels_per_m, const cv::Scalar& color, Rng rng) {
  cv::Mat image =
      PaintNoise(FractalNoise(size, Isotropic(0.4 * texels_per_m), 4, rng), color, 8.0, 3.0, rng);
  // Leaves strewn about, not in rows: a pattern that repeats would tempt the matcher unfairly.
  const double area_m2 = size.area() / (texels_per_m * texels_per_m);
  const int count = static_cast<int>(90.0 * area_m2);
  for (int i = 0; i < count; ++i) {
    const cv::Point at(RandomInt(rng, 0, size.width), RandomInt(rng, 0, size.height));
    const int length = Texels(rng.Uniform(0.02, 0.05), texels_per_m);
    const double angle_deg = rng.Uniform(0.0, 360.0);
    const cv::Scalar leaf = Shift(color, rng.Uniform(-60.0, 20.0));
    cv::ellipse(image, at, {length, std::max(1, length / 3)}, angle_deg, 0.0, 360.0, leaf,
                cv::FILLED, cv::LINE_AA);
    cv::ellipse(image, at, {length, std::max(1, length / 8)}, angle_deg, 0.0, 360.0,
                Shift(leaf, 25.0), cv::FILLED, cv::LINE_AA);
  }
  return image;
}

cv::Mat PaintBricks(cv::Size size, double texels_per_m, Rng rng) {
  const cv::Scalar mortar(168.0, 176.0, 182.0);
  const cv::Scalar clay(78.0, 96.0, 158.0);
  cv::Mat image = PaintNoise(FractalNoise(size, Isotropic(0.03 * texels_per_m), 3, rng), mortar,
                             14.0, 6.0, rng);
  const cv::Mat shade = FractalNoise(size, Isotropic(0.04 * texels_per_m), 4, rng);
  const int course = Texels(0.083, texels_per_m);
  const int joint = std::max(1, Texels(0.012, texels_per_m));
  for (int y = 0; y < size.height; y += course) {
    int x = -Texels(rng.Uniform(0.02, 0.24), texels_per_m);
    while (x < size.width) {
      const int length = Texels(rng.Uniform(0.19, 0.26), texels_per_m);
      const cv::Rect brick =
          cv::Rect(x, y + RandomInt(rng, 0, joint / 2), length - joint, course - joint) &
          cv::Rect(0, 0, size.width, size.height);
      x += length;
      if (brick.empty()) continue;
      const cv::Scalar tone(clay[0] + rng.Uniform(-14.0, 14.0), clay[1] + rng.Uniform(-22.0, 22.0),
                            clay[2] + rng.Uniform(-42.0, 30.0));
      PaintNoise(shade(brick), tone, 22.0, 7.0, rng).copyTo(image(brick));
    }
  }
  const double area_m2 = size.area() / (texels_per_m * texels_per_m);
  return WithScuffs(image, static_cast<int>(60.0 * area_m2), 0.006 * texels_per_m, 60.0, rng);
}

cv::Mat PaintPlanks(cv::Size size, double texels_per_m, Rng rng) {
  cv::Mat image(size, CV_8UC3);
  const int width = Texels(0.13, texels_per_m);
  for (int y = 0; y < size.height; y += width) {
    int x = -Texels(rng.Uniform(0.0, 1.2), texels_per_m);
    while (x < size.width) {
      const int length = Texels(rng.Uniform(0.7, 1.5), texels_per_m);
      const cv::Rect plank =
          cv::Rect(x, y, length, width) & cv::Rect(0, 0, size.width, size.height);
      x += length;
      if (plank.empty()) continue;
      const double tone = rng.Uniform(-24.0, 24.0);
      const cv::Scalar color(88.0 + tone, 128.0 + tone, 168.0 + 1.1 * tone);
      WoodGrain(plank.size(), texels_per_m, color, rng).copyTo(image(plank));
      cv::rectangle(image, plank, Shift(color, -55.0), 1);
    }
  }
  const double area_m2 = size.area() / (texels_per_m * texels_per_m);
  return WithScuffs(image, static_cast<int>(14.0 * area_m2), 0.008 * texels_per_m, 70.0, rng);
}

cv::Mat PaintWood(cv::Size size, double texels_per_m, const cv::Scalar& color, Rng rng) {
  cv::Mat image = WoodGrain(size, texels_per_m, color, rng);
  const double area_m2 = size.area() / (texels_per_m * texels_per_m);
  const int knots = static_cast<int>(7.0 * area_m2);
  for (int i = 0; i < knots; ++i) {
    const cv::Point at(RandomInt(rng, 0, size.width), RandomInt(rng, 0, size.height));
    const int radius = Texels(rng.Uniform(0.006, 0.018), texels_per_m);
    for (int r = radius; r > 0; r -= std::max(1, radius / 4))
      cv::ellipse(image, at, {2 * r, r}, 0.0, 0.0, 360.0, Shift(color, -70.0 + 35.0 * r / radius),
                  cv::FILLED, cv::LINE_AA);
  }
  return WithScuffs(image, static_cast<int>(25.0 * area_m2), 0.004 * texels_per_m, 60.0, rng);
}

cv::Mat PaintFabric(cv::Size size, double texels_per_m, const cv::Scalar& color, Rng rng) {
  cv::Mat noise = FractalNoise(size, Isotropic(0.2 * texels_per_m), 6, rng);
  const int stripe = Texels(0.045, texels_per_m);
  for (int x = 0; x < size.width;) {  // uneven stripes of lighter and darker yarn
    const int width = std::max(1, static_cast<int>(stripe * rng.Uniform(0.4, 1.8)));
    noise.colRange(x, std::min(size.width, x + width)) += rng.Uniform(-0.9, 0.9);
    x += width;
  }
  return PaintNoise(noise, color, 20.0, 9.0, rng);
}

cv::Mat PaintRug(cv::Size size, double texels_per_m, Rng rng) {
  cv::Mat image = PaintNoise(FractalNoise(size, Isotropic(0.1 * texels_per_m), 4, rng),
                             {60.0, 52.0, 128.0}, 16.0, 8.0, rng);
  const int border = Texels(0.09, texels_per_m);
  for (int k = 1; k <= 3; ++k) {
    const cv::Rect frame(k * border, k * border, size.width - 2 * k * border,
                         size.height - 2 * k * border);
    if (frame.width <= 0 || frame.height <= 0) break;
    cv::rectangle(image, frame, RandomColor(rng, 0.5, 0.8), std::max(1, border / (2 * k)));
  }
  const double area_m2 = size.area() / (texels_per_m * texels_per_m);
  const int motifs = static_cast<int>(40.0 * area_m2);
  for (int i = 0; i < motifs; ++i) {
    const cv::Point at(RandomInt(rng, 0, size.width), RandomInt(rng, 0, size.height));
    const int radius = Texels(rng.Uniform(0.02, 0.08), texels_per_m);
    const cv::Scalar color = RandomColor(rng, 0.55, rng.Uniform(0.3, 0.9));
    const std::vector<cv::Point> diamond{{at.x, at.y - radius},
                                         {at.x + 2 * radius / 3, at.y},
                                         {at.x, at.y + radius},
                                         {at.x - 2 * radius / 3, at.y}};
    cv::fillConvexPoly(image, diamond, color, cv::LINE_AA);
    cv::circle(image, at, std::max(1, radius / 3), Shift(color, -70.0), cv::FILLED, cv::LINE_AA);
  }
  return image;
}

cv::Mat PaintCeiling(cv::Size size, double texels_per_m, Rng rng) {
  const cv::Scalar white(212.0, 216.0, 218.0);
  cv::Mat image =
      PaintNoise(FractalNoise(size, Isotropic(0.5 * texels_per_m), 5, rng), white, 6.0, 3.0, rng);
  const double area_m2 = size.area() / (texels_per_m * texels_per_m);
  image = WithScuffs(image, static_cast<int>(250.0 * area_m2), 0.006 * texels_per_m, 80.0, rng);
  const int tile = Texels(0.62, texels_per_m);
  for (int x = tile / 2; x < size.width; x += tile)
    cv::line(image, {x, 0}, {x, size.height}, Shift(white, -60.0), Texels(0.01, texels_per_m));
  for (int y = tile / 3; y < size.height; y += tile)
    cv::line(image, {0, y}, {size.width, y}, Shift(white, -60.0), Texels(0.01, texels_per_m));
  return image;
}

cv::Mat PaintCardboard(cv::Size size, double texels_per_m, Rng rng) {
  const double tone = rng.Uniform(-22.0, 18.0);
  const cv::Scalar brown(98.0 + tone, 138.0 + tone, 172.0 + tone);
  cv::Mat image = PaintNoise(FractalNoise(size, {0.3 * texels_per_m, 0.02 * texels_per_m}, 5, rng),
                             brown, 10.0, 4.0, rng);
  const int tape = size.height / 8;
  cv::rectangle(image,
                cv::Rect(0, RandomInt(rng, size.height / 3, size.height / 2), size.width, tape),
                Shift(brown, 28.0), cv::FILLED);
  for (int i = 0; i < 3; ++i) {  // a printed mark, a stamp, an address label
    const cv::Rect area(RandomInt(rng, 0, size.width / 2), RandomInt(rng, 0, 2 * size.height / 3),
                        RandomInt(rng, size.width / 5, size.width / 2),
                        RandomInt(rng, size.height / 8, size.height / 4));
    const bool is_label = rng.Uniform() < 0.5;
    if (is_label) cv::rectangle(image, area, Shift(brown, 90.0), cv::FILLED);
    image = is_label ? WithText(image, {area, std::max(5.0, area.height / 4.0), {30, 30, 40}}, rng)
                     : WithHeadline(image, area, Shift(brown, -90.0), rng);
  }
  return image;
}

cv::Mat PaintPlain(cv::Size size, const cv::Scalar& color, Rng rng) {
  return PaintNoise(FractalNoise(size, Isotropic(0.3 * size.width), 4, rng), color, 7.0, 3.0, rng);
}

}  // namespace cslam
