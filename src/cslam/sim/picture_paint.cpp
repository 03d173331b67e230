// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/picture_paint.h"

#include "cslam/sim/paint_tools.h"
#include "cslam/sim/surface_paint.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace cslam {
namespace {

// A part of the image, given by shares of its size; at least one texel.
cv::Rect Inner(cv::Size size, double left, double top, double right, double bottom) {
  const auto at = [](double share, int length) { return static_cast<int>(share * length); };
  const cv::Point corner(at(left, size.width), at(top, size.height));
  return {corner.x, corner.y, std::max(1, at(right, size.width) - corner.x),
          std::max(1, at(bottom, size.height) - corner.y)};
}

cv::Rect RandomRect(cv::Size size, double min_share, double max_share, Rng& rng) {
  const int width = std::max(2, static_cast<int>(size.width * rng.Uniform(min_share, max_share)));
  const int height = std::max(2, static_cast<int>(size.height * rng.Uniform(min_share, max_share)));
  return {RandomInt(rng, 0, std::max(0, size.width - width)),
          RandomInt(rng, 0, std::max(0, size.height - height)), width, height};
}

cv::Mat Ground(cv::Size size, const cv::Scalar& color, double amplitude, Rng& rng) {
  return PaintNoise(FractalNoise(size, cv::Size2d(0.4 * size.width, 0.4 * size.height), 6, rng),
                    color, amplitude, 3.0, rng);
}

void Hills(cv::Mat& image, double base, Rng& rng) {
  const cv::Mat outline = FractalNoise({image.cols, 2}, {0.35 * image.cols, 2.0}, 5, rng);
  std::vector<cv::Point> hill{{0, image.rows}};
  for (int x = 0; x < image.cols; ++x) {
    const double height = base + 0.14 * static_cast<double>(outline.at<float>(0, x));
    hill.emplace_back(x, static_cast<int>(height * image.rows));
  }
  hill.emplace_back(image.cols, image.rows);
  cv::fillPoly(image, std::vector<std::vector<cv::Point>>{hill},
               RandomColor(rng, 0.45, rng.Uniform(0.25, 0.6)), cv::LINE_AA);
}

void House(cv::Mat& image, Rng& rng) {
  cv::Rect body = RandomRect(image.size(), 0.07, 0.2, rng);
  body.y = image.rows / 2 + body.y / 3;
  body &= cv::Rect(0, 0, image.cols, image.rows);
  if (body.width < 4 || body.height < 4) return;
  cv::rectangle(image, body, RandomColor(rng, 0.25, rng.Uniform(0.5, 0.95)), cv::FILLED);
  const std::vector<cv::Point> roof{{body.x - body.width / 8, body.y},
                                    {body.x + body.width / 2, body.y - body.height / 2},
                                    {body.x + body.width + body.width / 8, body.y}};
  cv::fillConvexPoly(image, roof, RandomColor(rng, 0.6, 0.5), cv::LINE_AA);
  const int pane = std::max(1, body.width / 6);
  for (int y = body.y + pane; y + pane < body.y + body.height; y += 2 * pane) {
    for (int x = body.x + pane; x + pane < body.x + body.width; x += 2 * pane) {
      if (rng.Uniform() < 0.8) {
        cv::rectangle(image, {x, y, pane, pane}, cv::Scalar::all(rng.Uniform(20.0, 90.0)),
                      cv::FILLED);
      }
    }
  }
}

void Shape(cv::Mat& image, Rng& rng) {
  const cv::Rect box = RandomRect(image.size(), 0.06, 0.4, rng);
  const cv::Scalar color = RandomColor(rng, rng.Uniform(0.3, 0.9), rng.Uniform(0.2, 1.0));
  const int kind = RandomInt(rng, 0, 3);
  if (kind == 0) {
    cv::rectangle(image, box, color, cv::FILLED);
  } else if (kind == 1) {
    cv::ellipse(image, {box.x + box.width / 2, box.y + box.height / 2},
                {box.width / 2, box.height / 2}, rng.Uniform(0.0, 180.0), 0.0, 360.0, color,
                cv::FILLED, cv::LINE_AA);
  } else {
    std::vector<cv::Point> corners;
    corners.reserve(4);
    for (int i = 0; i < kind + 1; ++i)
      corners.emplace_back(RandomInt(rng, box.x, box.x + box.width),
                           RandomInt(rng, box.y, box.y + box.height));
    cv::fillConvexPoly(image, corners, color, cv::LINE_AA);
  }
}

void PaintOver(cv::Mat& image, const cv::Rect& area, const cv::Mat& part) {
  const cv::Rect inside = area & cv::Rect(0, 0, image.cols, image.rows);
  if (inside.empty()) return;
  part(cv::Rect(inside.x - area.x, inside.y - area.y, inside.width, inside.height))
      .copyTo(image(inside));
}

}  // namespace

cv::Mat PaintPhoto(cv::Size size, Rng rng) {
  cv::Mat image = Ground(size, RandomColor(rng, 0.35, 0.85), 28.0, rng);
  const int ranges = RandomInt(rng, 2, 4);
  for (int i = 0; i < ranges; ++i)
    Hills(image, 0.35 + 0.5 * i / ranges, rng);
  const int houses = RandomInt(rng, 4, 9);
  for (int i = 0; i < houses; ++i)
    House(image, rng);
  cv::Mat grain = FractalNoise(size, {0.02 * size.width, 0.02 * size.width}, 3, rng);
  cv::Mat bgr_grain;
  cv::merge(std::vector<cv::Mat>{grain, grain, grain}, bgr_grain);
  cv::Mat result;
  cv::add(image, 22.0 * bgr_grain, result, cv::noArray(), CV_8U);
  return result;
}

cv::Mat PaintPoster(cv::Size size, Rng rng) {
  const cv::Scalar paper = RandomColor(rng, rng.Uniform(0.05, 0.6), rng.Uniform(0.6, 0.95));
  const cv::Scalar ink = RandomColor(rng, 0.5, 0.25);
  cv::Mat image = Ground(size, paper, 8.0, rng);
  const bool photo_first = rng.Uniform() < 0.5;
  const cv::Rect picture =
      photo_first ? Inner(size, 0.06, 0.04, 0.94, 0.55) : Inner(size, 0.06, 0.25, 0.94, 0.75);
  if (rng.Uniform() < 0.6) {
    PaintOver(image, picture, PaintPhoto(picture.size(), Rng(rng.NextUint64())));
  } else {
    cv::Mat part = image(picture);
    for (int i = 0; i < 14; ++i)
      Shape(part, rng);
  }
  image = WithHeadline(
      image,
      photo_first ? Inner(size, 0.06, 0.59, 0.94, 0.68) : Inner(size, 0.06, 0.08, 0.94, 0.18), ink,
      rng);
  const cv::Rect print =
      photo_first ? Inner(size, 0.08, 0.73, 0.92, 0.97) : Inner(size, 0.08, 0.79, 0.92, 0.97);
  image = WithText(image, {print, size.height / 32.0, ink}, rng);
  cv::rectangle(image, cv::Rect(0, 0, size.width, size.height), Shift(ink, 10.0),
                std::max(1, size.width / 60));
  return image;
}

cv::Mat PaintPage(cv::Size size, Rng rng) {
  cv::Mat image = Ground(size, {232, 236, 238}, 4.0, rng);
  const cv::Scalar ink(40, 36, 34);
  image = WithHeadline(image, Inner(size, 0.1, 0.05, 0.9, 0.12), ink, rng);
  const double figure = rng.Uniform(0.2, 0.6);
  image = WithText(image, {Inner(size, 0.1, 0.17, 0.9, figure), size.height / 34.0, ink}, rng);
  const cv::Rect plot = Inner(size, 0.15, figure + 0.02, 0.85, figure + 0.25);
  PaintOver(image, plot, PaintPhoto(plot.size(), Rng(rng.NextUint64())));
  return WithText(image, {Inner(size, 0.1, figure + 0.29, 0.9, 0.96), size.height / 34.0, ink},
                  rng);
}

cv::Mat PaintScreen(cv::Size size, Rng rng) {
  cv::Mat image = PaintPhoto(size, Rng(rng.NextUint64()));
  for (int i = 0; i < 3; ++i) {
    const cv::Rect window = RandomRect(size, 0.35, 0.7, rng);
    const bool dark = rng.Uniform() < 0.5;
    const cv::Scalar ground = dark ? cv::Scalar(42, 34, 30) : cv::Scalar(240, 238, 236);
    cv::rectangle(image, window, ground, cv::FILLED);
    const int bar = std::max(2, window.height / 14);
    cv::rectangle(image, {window.x, window.y, window.width, bar}, RandomColor(rng, 0.5, 0.6),
                  cv::FILLED);
    for (int y = window.y + 2 * bar; y < window.y + window.height - bar; y += bar) {
      const int indent = RandomInt(rng, 0, 4) * window.width / 16;
      const int width = static_cast<int>((window.width - indent) * rng.Uniform(0.2, 0.9));
      const cv::Scalar ink = RandomColor(rng, 0.6, dark ? 0.9 : 0.4);
      image = WithText(image, {{window.x + 4 + indent, y, width, bar}, 1.0 * bar, ink}, rng);
    }
  }
  return image;
}

cv::Mat PaintKeyboard(cv::Size size, Rng rng) {
  const bool dark = rng.Uniform() < 0.6;
  const cv::Scalar body = dark ? cv::Scalar(46, 42, 40) : cv::Scalar(190, 196, 198);
  const cv::Scalar cap = Shift(body, dark ? 36.0 : 30.0);
  cv::Mat image = Ground(size, body, 4.0, rng);
  constexpr int kRows = 6;
  const double row = size.height / (kRows + 0.6);
  for (int r = 0; r < kRows; ++r) {
    double x = 0.3 * row;
    while (x < size.width - 0.9 * row) {
      const double width =
          row * (r == kRows - 1 && rng.Uniform() < 0.2 ? 5.0 : (rng.Uniform() < 0.15 ? 1.6 : 1.0));
      const cv::Rect key(static_cast<int>(x), static_cast<int>(row * (r + 0.35)),
                         static_cast<int>(std::min(width, size.width - 0.3 * row - x) - 0.15 * row),
                         static_cast<int>(0.82 * row));
      cv::rectangle(image, key, Shift(cap, rng.Uniform(-8.0, 8.0)), cv::FILLED);
      const cv::Scalar letter = dark ? cv::Scalar(220, 220, 220) : cv::Scalar(40, 40, 40);
      image = WithText(image,
                       {{key.x + 1, key.y + 1, key.width / 2, key.height}, 0.7 * row, letter}, rng);
      x += width;
    }
  }
  return image;
}

cv::Mat PaintBookSpine(cv::Size size, Rng rng) {
  const cv::Scalar cover = RandomColor(rng, rng.Uniform(0.1, 0.8), rng.Uniform(0.2, 0.9));
  const bool is_light = cover[0] + cover[1] + cover[2] > 380.0;
  const cv::Scalar ink = Shift(cover, is_light ? -130.0 : 130.0);
  // Painted lying down, then stood up: titles run along the spine.
  cv::Mat lying = Ground({size.height, size.width}, cover, 8.0, rng);
  const int bands = RandomInt(rng, 0, 3);
  for (int i = 0; i < bands; ++i) {
    const int x = static_cast<int>(lying.cols * rng.Uniform(0.03, 0.95));
    cv::line(lying, {x, 0}, {x, lying.rows}, RandomColor(rng, 0.5, 0.8), RandomInt(rng, 1, 5));
  }
  lying =
      WithHeadline(lying, Inner(lying.size(), rng.Uniform(0.08, 0.25), 0.25, 0.75, 0.75), ink, rng);
  cv::rectangle(lying, Inner(lying.size(), 0.84, 0.2, 0.94, 0.8), RandomColor(rng, 0.4, 0.7),
                cv::FILLED);
  cv::Mat standing;
  cv::rotate(lying, standing, cv::ROTATE_90_CLOCKWISE);
  cv::rectangle(standing, cv::Rect(0, 0, size.width, size.height), Shift(cover, -50.0), 1);
  return standing;
}

cv::Mat PaintNotesBoard(cv::Size size, Rng rng) {
  cv::Mat image = PaintNoise(FractalNoise(size, {size.width / 60.0, size.width / 60.0}, 3, rng),
                             {92, 140, 186}, 26.0, 10.0, rng);
  for (int i = 0; i < 16; ++i) {
    const cv::Rect sheet = RandomRect(size, 0.1, 0.26, rng);
    const cv::Mat part =
        rng.Uniform() < 0.5 ? PaintPage(sheet.size(), Rng(rng.NextUint64()))
        : rng.Uniform() < 0.5
            ? PaintPhoto(sheet.size(), Rng(rng.NextUint64()))
            : WithText(Ground(sheet.size(), RandomColor(rng, 0.6, 0.95), 4.0, rng),
                       {Inner(sheet.size(), 0.1, 0.1, 0.9, 0.9), sheet.height / 6.0, {60, 30, 30}},
                       rng);
    PaintOver(image, sheet, part);
    cv::circle(image, {sheet.x + sheet.width / 2, sheet.y + 4}, std::max(2, size.width / 160),
               RandomColor(rng, 0.9, 0.8), cv::FILLED, cv::LINE_AA);
  }
  cv::rectangle(image, cv::Rect(0, 0, size.width, size.height), {50, 76, 104}, size.width / 40);
  return image;
}

cv::Mat PaintWhiteboard(cv::Size size, Rng rng) {
  cv::Mat image = Ground(size, {228, 230, 230}, 6.0, rng);
  const int pen = std::max(1, size.width / 300);
  for (int i = 0; i < 7; ++i) {
    const cv::Rect area = RandomRect(size, 0.12, 0.34, rng);
    const cv::Scalar ink = RandomColor(rng, 0.85, 0.55);
    if (rng.Uniform() < 0.5) {
      cv::rectangle(image, area, ink, pen, cv::LINE_AA);
      cv::arrowedLine(image, {area.x + area.width, area.y + area.height / 2},
                      {RandomInt(rng, 0, size.width), RandomInt(rng, 0, size.height)}, ink, pen,
                      cv::LINE_AA);
    }
    image = WithText(image, {area, size.height / 16.0, ink}, rng);
  }
  cv::rectangle(image, cv::Rect(0, 0, size.width, size.height), {150, 150, 146}, size.width / 50);
  return image;
}

cv::Mat PaintDoor(cv::Size size, double texels_per_m, Rng rng) {
  const cv::Scalar color(70, 98, 132);
  cv::Mat image = PaintWood({size.height, size.width}, texels_per_m, color, Rng(rng.NextUint64()));
  cv::rotate(image, image, cv::ROTATE_90_CLOCKWISE);
  for (const auto& panel :
       {Inner(size, 0.14, 0.07, 0.86, 0.42), Inner(size, 0.14, 0.52, 0.86, 0.93)}) {
    cv::rectangle(image, panel, Shift(color, -45.0), std::max(1, size.width / 50));
    cv::rectangle(image, panel + cv::Point(size.width / 40, size.width / 40), Shift(color, 30.0),
                  1);
  }
  const cv::Rect sign = Inner(size, 0.3, 0.18, 0.7, 0.3);
  PaintOver(image, sign, PaintPage(sign.size(), Rng(rng.NextUint64())));
  cv::rectangle(image, Inner(size, 0.88, 0.46, 0.95, 0.52), {190, 196, 200}, cv::FILLED);
  return image;
}

cv::Mat PaintDrawers(cv::Size size, int rows, double texels_per_m, Rng rng) {
  const cv::Scalar color = RandomColor(rng, 0.2, rng.Uniform(0.45, 0.8));
  cv::Mat image = PaintWood(size, texels_per_m, color, Rng(rng.NextUint64()));
  for (int r = 0; r < rows; ++r) {
    const cv::Rect front(2, r * size.height / rows + 2, size.width - 4, size.height / rows - 4);
    cv::rectangle(image, front, Shift(color, -60.0), std::max(1, size.width / 120));
    const cv::Rect handle(front.x + front.width / 3, front.y + front.height / 5, front.width / 3,
                          std::max(2, front.height / 12));
    cv::rectangle(image, handle, {60, 58, 56}, cv::FILLED);
    const cv::Rect label(front.x + front.width / 2 - front.width / 10, front.y + front.height / 2,
                         front.width / 5, std::max(3, front.height / 6));
    cv::rectangle(image, label, {225, 230, 230}, cv::FILLED);
    image = WithText(image, {label, 0.45 * label.height, {40, 30, 30}}, rng);
  }
  return image;
}

cv::Mat PaintPackage(cv::Size size, Rng rng) {
  cv::Mat image =
      Ground(size, RandomColor(rng, rng.Uniform(0.2, 0.8), rng.Uniform(0.4, 0.95)), 10.0, rng);
  const int shapes = RandomInt(rng, 3, 8);
  for (int i = 0; i < shapes; ++i)
    Shape(image, rng);
  const cv::Scalar ink = RandomColor(rng, 0.4, rng.Uniform() < 0.5 ? 0.15 : 0.98);
  image = WithHeadline(image, Inner(size, 0.08, 0.1, 0.92, 0.3), ink, rng);
  return WithText(image, {Inner(size, 0.08, 0.68, 0.92, 0.94), size.height / 12.0, ink}, rng);
}

}  // namespace cslam
