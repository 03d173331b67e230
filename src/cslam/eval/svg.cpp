// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/eval/svg.h"

#include "cslam/util/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace cslam {

SvgImage::SvgImage(double width_px, double height_px)
    : width_px_(width_px), height_px_(height_px) {}

void SvgImage::Line(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                    std::string_view style) {
  fmt::format_to(std::back_inserter(body_),
                 "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", from.x(),
                 from.y(), to.x(), to.y(), style);
}

void SvgImage::Polyline(std::span<const Eigen::Vector2d> points, std::string_view style) {
  if (points.size() < 2) return;
  body_ += "<polyline points=\"";
  for (const Eigen::Vector2d& point : points)
    fmt::format_to(std::back_inserter(body_), "{:.1f},{:.1f} ", point.x(), point.y());
  body_.back() = '"';
  fmt::format_to(std::back_inserter(body_), " fill=\"none\" {}/>\n", style);
}

void SvgImage::Rectangle(const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
                         std::string_view style) {
  fmt::format_to(std::back_inserter(body_),
                 "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" {}/>\n",
                 corner.x(), corner.y(), size.x(), size.y(), style);
}

void SvgImage::Circle(const Eigen::Vector2d& centre, double radius_px, std::string_view style) {
  fmt::format_to(std::back_inserter(body_),
                 "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" {}/>\n", centre.x(), centre.y(),
                 radius_px, style);
}

void SvgImage::Text(const Eigen::Vector2d& at, std::string_view text, std::string_view style) {
  fmt::format_to(std::back_inserter(body_), "<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n",
                 at.x(), at.y(), style, EscapeXml(text));
}

std::string SvgImage::Document() const {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"'Helvetica Neue', Arial, 'DejaVu Sans', "
      "sans-serif\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{2}</svg>\n",
      width_px_, height_px_, body_);
}

std::string EscapeXml(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&apos;";
        break;
      default:
        escaped += static_cast<unsigned char>(c) < 0x20U ? ' ' : c;
    }
  }
  return escaped;
}

Ticks RoundTicks(double min, double max, int max_count) {
  CSLAM_CHECK(max > min && max_count > 0, "{} to {}, {}", min, max, max_count);
  const double least_step = (max - min) / max_count;
  const int exponent = static_cast<int>(std::floor(std::log10(least_step)));
  const double power = std::pow(10.0, exponent);
  double step = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * power >= least_step * (1.0 - 1e-9)) step = factor * power;
  }
  Ticks ticks;
  const bool is_whole_decade = step > 9.0 * power;
  ticks.decimals = std::max(0, -exponent - (is_whole_decade ? 1 : 0));
  // Counted in whole steps, so that zero is zero.
  const double last = std::floor(max / step * (1.0 + 1e-12));
  for (double i = std::ceil(min / step); i <= last; ++i)
    ticks.values.push_back(i * step + 0.0);
  return ticks;
}

}  // namespace cslam
