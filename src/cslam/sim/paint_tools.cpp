// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/paint_tools.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace cslam {
namespace {

cv::Mat RandomField(cv::Size size, cv::Size2d spacing_px, Rng& rng) {
  const auto cells = [](int length, double spacing) {
    return std::max(2, static_cast<int>(std::ceil(length / spacing)) + 1);
  };
  cv::Mat grid(cells(size.height, spacing_px.height), cells(size.width, spacing_px.width),
               CV_32FC1);
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.cols; ++c)
      grid.at<float>(r, c) = static_cast<float>(rng.Uniform(-1.0, 1.0));
  }
  cv::Mat field;
  cv::resize(grid, field, size, 0.0, 0.0, cv::INTER_CUBIC);
  return field;
}

}  // namespace

int RandomInt(Rng& rng, int low, int high) {
  const std::int64_t count = std::int64_t{high} - low + 1;
  return low + static_cast<int>(rng.Index(static_cast<std::uint64_t>(count)));
}

cv::Mat FractalNoise(cv::Size size, cv::Size2d spacing_px, int octaves, Rng& rng) {
  cv::Mat sum = cv::Mat::zeros(size, CV_32FC1);
  double strength = 0.6;
  for (int i = 0; i < octaves; ++i, strength *= 0.6) {
    const cv::Size2d spacing(std::max(1.0, spacing_px.width), std::max(1.0, spacing_px.height));
    sum += strength * RandomField(size, spacing, rng);
    spacing_px = {0.5 * spacing_px.width, 0.5 * spacing_px.height};
  }
  return sum;
}

cv::Mat PaintNoise(const cv::Mat& noise, const cv::Scalar& color, double amplitude, double grain,
                   Rng& rng) {
  cv::Mat image(noise.size(), CV_8UC3);
  for (int v = 0; v < image.rows; ++v) {
    const auto* from = noise.ptr<float>(v);
    auto* to = image.ptr<cv::Vec3b>(v);
    for (int u = 0; u < image.cols; ++u) {
      // The sum of two even values: near enough to a normal one, and quick.
      const double speck = grain * 2.4 * (rng.Uniform() + rng.Uniform() - 1.0);
      const double level = amplitude * static_cast<double>(from[u]) + speck;
      for (int c = 0; c < 3; ++c)
        to[u][c] = cv::saturate_cast<unsigned char>(color[c] + level);
    }
  }
  return image;
}

cv::Scalar RandomColor(Rng& rng, double saturation, double value) {
  // 0 blue, 2 red, 3 yellow, 4 green. Rooms hold more warm things than cold ones.
  const double hue = rng.Uniform() < 0.55 ? rng.Uniform(1.8, 3.2) : rng.Uniform(0.0, 6.0);
  cv::Scalar color;
  for (int c = 0; c < 3; ++c) {
    const double distance = std::abs(std::fmod(hue + 2.0 * c, 6.0) - 3.0);
    const double ramp = std::clamp(distance - 1.0, 0.0, 1.0);
    color[c] = 255.0 * value * (1.0 - saturation * (1.0 - ramp));
  }
  return color;
}

cv::Scalar Shift(const cv::Scalar& color, double levels) {
  return {color[0] + levels, color[1] + levels, color[2] + levels};
}

std::string RandomWords(int num_letters, Rng& rng) {
  static constexpr char kLetters[] = "etaoinshrdlucmfwypvbgkqjxzETAOINSHRDL0123456789";
  std::string words;
  int until_space = RandomInt(rng, 2, 8);
  for (int i = 0; i < num_letters; ++i) {
    if (until_space-- == 0) {
      words += ' ';
      until_space = RandomInt(rng, 2, 9);
    } else {
      words += kLetters[rng.Index(sizeof(kLetters) - 1)];
    }
  }
  return words;
}

cv::Mat WithText(cv::Mat image, const TextBlock& block, Rng& rng) {
  const cv::Rect area = block.area & cv::Rect(0, 0, image.cols, image.rows);
  if (area.width < 4 || area.height < 4) return image;
  cv::Mat part = image(area);
  // A Hershey letter at scale 1 is about 22 px high and 18 px wide.
  const double scale = std::max(0.12, 0.6 * block.line_px / 22.0);
  const int thickness = std::max(1, static_cast<int>(std::lround(block.line_px / 14.0)));
  const int letters = std::max(1, static_cast<int>(part.cols / (18.0 * scale)));
  for (double y = 0.8 * block.line_px; y < part.rows; y += block.line_px) {
    const int count = block.ragged ? RandomInt(rng, std::max(1, letters / 3), letters) : letters;
    cv::putText(part, RandomWords(count, rng), {1, static_cast<int>(y)}, cv::FONT_HERSHEY_SIMPLEX,
                scale, block.color, thickness, cv::LINE_AA);
  }
  return image;
}

cv::Mat WithHeadline(cv::Mat image, const cv::Rect& area, const cv::Scalar& color, Rng& rng) {
  const int letters = RandomInt(rng, 5, 11);
  const double scale = std::min(area.width / (19.0 * letters), area.height / 24.0);
  if (scale < 0.1) return image;
  const int thickness = std::max(1, static_cast<int>(std::lround(4.0 * scale)));
  cv::putText(image, RandomWords(letters, rng), {area.x, area.y + area.height},
              cv::FONT_HERSHEY_DUPLEX, scale, color, thickness, cv::LINE_AA);
  return image;
}

cv::Size TexelSize(double width_m, double height_m, double texels_per_m) {
  const auto texels = [&](double length_m) {
    return std::max(4, static_cast<int>(std::lround(length_m * texels_per_m)));
  };
  return {texels(width_m), texels(height_m)};
}

}  // namespace cslam
