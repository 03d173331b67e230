// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace cslam {

// An upright rectangle in an image, in px; pixel (u, v) covers u <= x < u + 1, v <= y < v + 1, so
// that a box around one pixel has the area 1.
struct Box {
  double x_min = 0.0;
  double y_min = 0.0;
  double x_max = 0.0;
  double y_max = 0.0;

  double width() const { return std::max(0.0, x_max - x_min); }
  double height() const { return std::max(0.0, y_max - y_min); }
  double area() const { return width() * height(); }
  bool empty() const { return !(x_max > x_min && y_max > y_min); }  // NaN counts as empty
  bool Contains(double x, double y) const {
    return x >= x_min && x < x_max && y >= y_min && y < y_max;
  }
  bool operator==(const Box&) const = default;
};

inline Box Intersect(const Box& a, const Box& b) {
  return {std::max(a.x_min, b.x_min), std::max(a.y_min, b.y_min), std::min(a.x_max, b.x_max),
          std::min(a.y_max, b.y_max)};
}

// Intersection over union, 0 to 1; 0 if either is empty.
inline double Iou(const Box& a, const Box& b) {
  if (a.empty() || b.empty()) return 0.0;
  const double common = Intersect(a, b).area();
  return common / (a.area() + b.area() - common);
}

}  // namespace cslam
