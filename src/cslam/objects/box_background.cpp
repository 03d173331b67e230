// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/box_background.h"

#include "cslam/util/options.h"
#include "cslam/util/random.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace cslam {
namespace {

constexpr int kMaxPlanes = 3;
constexpr int kNumTrials = 40;
constexpr std::size_t kMinReadings = 12;

struct Reading {
  int u = 0;
  int v = 0;
  double z = 0.0;  // m
};

// Planes are linear in inverse depth: 1 / z = p . (u, v, 1).
using Plane = Eigen::Vector3d;

bool IsOn(const Plane& plane, const Reading& r, const BoxBackgroundOptions& options) {
  const double inverse = plane.dot(Eigen::Vector3d(r.u, r.v, 1.0));
  if (inverse <= 0.0) return false;
  const double tolerance = std::max(options.tolerance_m, options.tolerance_per_m2 * r.z * r.z);
  return std::abs(1.0 / inverse - r.z) <= tolerance;
}

std::vector<Reading> ReadingsIn(const DepthView& view, const cv::Rect& rect, const cv::Rect& hole,
                                const cv::Mat& excluded) {
  std::vector<Reading> readings;
  for (int v = rect.y; v < rect.y + rect.height; ++v) {
    for (int u = rect.x; u < rect.x + rect.width; ++u) {
      if (hole.contains(cv::Point(u, v))) continue;
      if (!excluded.empty() && excluded.at<std::uint8_t>(v, u) != 0) continue;
      const double z = static_cast<double>(view.DepthM(u, v));
      if (z > 0.0) readings.push_back({u, v, z});
    }
  }
  return readings;
}

std::optional<Plane> Through(const Reading& a, const Reading& b, const Reading& c) {
  Eigen::Matrix3d uv;
  uv << a.u, a.v, 1.0, b.u, b.v, 1.0, c.u, c.v, 1.0;
  if (std::abs(uv.determinant()) < 4.0) return std::nullopt;
  return uv.inverse() * Eigen::Vector3d(1.0 / a.z, 1.0 / b.z, 1.0 / c.z);
}

Plane FitTo(const std::vector<Reading>& readings) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const Reading& r : readings) {
    const Eigen::Vector3d uv1(r.u, r.v, 1.0);
    A += uv1 * uv1.transpose();
    b += uv1 / r.z;
  }
  return A.ldlt().solve(b);
}

// The plane that most of the readings lie on.
std::optional<Plane> FindPlane(const std::vector<Reading>& readings, std::size_t min_support,
                               Rng& rng, const BoxBackgroundOptions& options) {
  std::vector<Reading> best;
  for (int trial = 0; trial < kNumTrials; ++trial) {
    const auto plane =
        Through(readings[rng.Index(readings.size())], readings[rng.Index(readings.size())],
                readings[rng.Index(readings.size())]);
    if (!plane) continue;
    std::vector<Reading> on;
    for (const Reading& r : readings) {
      if (IsOn(*plane, r, options)) on.push_back(r);
    }
    if (on.size() > best.size()) best = std::move(on);
  }
  if (best.size() < min_support) return std::nullopt;
  return FitTo(best);
}

// Whether it is upright, more or less, in a camera that is.
bool IsUpright(const Plane& plane, const DepthView& view) {
  constexpr double kMaxSlope = 0.5;  // 30 degrees off
  const Camera& camera = view.camera;
  const double step = view.step;
  const Eigen::Vector3d normal(plane.x() * camera.fx / step, plane.y() * camera.fy / step,
                               (plane.x() * camera.cx + plane.y() * camera.cy) / step + plane.z());
  return std::abs(normal.y()) < kMaxSlope * normal.norm();
}

std::vector<Plane> FindPlanes(std::vector<Reading> ring, const BoxBackgroundOptions& options) {
  std::vector<Plane> planes;
  const auto min_support =
      std::max(kMinReadings,
               static_cast<std::size_t>(options.min_support * static_cast<double>(ring.size())));
  Rng rng(ring.size());
  while (static_cast<int>(planes.size()) < kMaxPlanes && ring.size() >= min_support) {
    const auto plane = FindPlane(ring, min_support, rng, options);
    if (!plane) break;
    std::erase_if(ring, [&](const Reading& r) { return IsOn(*plane, r, options); });
    planes.push_back(*plane);
  }
  return planes;
}

}  // namespace

void Describe(OptionList& list, BoxBackgroundOptions& o) {
  list.Add("enabled", o.enabled,
           "Leave floor and wall out of boxes: planes that are seen around them.");
  list.Add("ring", o.ring_share, {0.01, 1.0}, "",
           "Width of the ring around a box that is looked at, as share of the box's size.");
  list.Add("min_support", o.min_support, {0.01, 1.0}, "",
           "Share of the ring's readings that make a plane.");
  list.Add("tolerance", o.tolerance_m, {0.001, 0.5}, "m", "How far a plane's readings lie off.");
  list.Add("tolerance_per_m2", o.tolerance_per_m2, {0.0, 0.1}, "1/m",
           "The same, times the depth squared, if that is more: noise of the sensor.");
  list.Add("min_foreground", o.min_foreground, {0.0, 1.0}, "",
           "Less of the box left over, and all of it counts: flat things.");
}

BoxBackground FindBoxBackground(const DepthView& view, const cv::Rect& rect,
                                const cv::Mat& excluded, const BoxBackgroundOptions& options) {
  constexpr int kMinRingPx = 3;
  if (!options.enabled) return {};
  const int margin = std::max(
      kMinRingPx, static_cast<int>(options.ring_share * std::max(rect.width, rect.height)));
  const cv::Rect around = cv::Rect(rect.x - margin, rect.y - margin, rect.width + 2 * margin,
                                   rect.height + 2 * margin) &
                          cv::Rect(0, 0, view.depth_mm.cols, view.depth_mm.rows);
  const std::vector<Plane> planes = FindPlanes(ReadingsIn(view, around, rect, excluded), options);
  if (planes.empty()) return {};
  cv::Mat background = cv::Mat::zeros(view.depth_mm.size(), CV_8UC1);
  const std::vector<Reading> inside = ReadingsIn(view, around, {}, excluded);
  std::size_t num_in_box = 0;
  std::size_t num_left = 0;
  for (const Reading& r : inside) {
    const bool is_on = std::any_of(planes.begin(), planes.end(),
                                   [&](const Plane& plane) { return IsOn(plane, r, options); });
    if (is_on) background.at<std::uint8_t>(r.v, r.u) = 255;
    if (!rect.contains(cv::Point(r.u, r.v))) continue;
    ++num_in_box;
    num_left += is_on ? 0 : 1;
  }
  const auto min_left = options.min_foreground * static_cast<double>(num_in_box);
  const bool is_flat = num_left < kMinReadings || static_cast<double>(num_left) < min_left;
  if (!is_flat) return {background, false, false};
  return {cv::Mat(), true, IsUpright(planes.front(), view)};
}

}  // namespace cslam
