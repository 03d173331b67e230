// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cslam {

// An SVG image put together element by element; later ones cover earlier ones. Coordinates are
// pixels, x right, y down. style: presentation attributes such as R"(stroke="#333")".
class SvgImage {
 public:
  SvgImage(double width_px, double height_px);

  void Line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, std::string_view style);
  // Nothing for fewer than two points.
  void Polyline(std::span<const Eigen::Vector2d> points, std::string_view style);
  void Rectangle(const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
                 std::string_view style);
  void Circle(const Eigen::Vector2d& centre, double radius_px, std::string_view style);
  // at: on the base line; text is escaped.
  void Text(const Eigen::Vector2d& at, std::string_view text, std::string_view style);

  // The whole document.
  std::string Document() const;

 private:
  double width_px_;
  double height_px_;
  std::string body_;
};

// "&", "<", ">" and quotes as entities; control characters, which XML forbids, as blanks.
std::string EscapeXml(std::string_view text);

// Round positions (1, 2 or 5 times a power of ten apart) within [min, max].
struct Ticks {
  std::vector<double> values;
  int decimals = 0;  // that tell them apart
};
Ticks RoundTicks(double min, double max, int max_count);

}  // namespace cslam
