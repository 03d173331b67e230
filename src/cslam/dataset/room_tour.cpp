// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/room_tour.h"

#include "cslam/util/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cslam {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kRingStepDeg = 10.0;

}  // namespace

std::vector<TimedView> RingViews(const RingWalk& ring, double start_s, double end_s) {
  const double turn_deg = ring.to_deg - ring.from_deg;
  const double lead_deg = turn_deg < 0.0 ? -ring.lead_deg : ring.lead_deg;
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(turn_deg) / kRingStepDeg)));
  std::vector<TimedView> views;
  for (int i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    const double angle_rad = (ring.from_deg + share * turn_deg) * kDegree;
    const Eigen::Vector2d p =
        ring.center_m + ring.radius_m * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
    views.push_back(
        {start_s + share * (end_s - start_s),
         {{p.x(), p.y(), ring.height_m}, angle_rad + lead_deg * kDegree, ring.pitch_deg * kDegree},
         0.0});
  }
  return views;
}

CameraMotion OneAfterTheOther(std::vector<CameraMotion> parts) {
  CSLAM_CHECK(!parts.empty());
  CameraMotion whole;
  for (const CameraMotion& part : parts)
    whole.duration_s += part.duration_s;
  whole.T_world_camera = [parts = std::move(parts)](double time_s) {
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
      if (time_s < parts[i].duration_s) return parts[i].T_world_camera(time_s);
      time_s -= parts[i].duration_s;
    }
    return parts.back().T_world_camera(time_s);
  };
  return whole;
}

std::function<double(double time_s)> PiecewiseLinear(
    std::vector<std::pair<double, double>> points) {
  CSLAM_CHECK(!points.empty());
  return [points = std::move(points)](double time_s) {
    if (time_s <= points.front().first) return points.front().second;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const auto& [from_s, from] = points[i - 1];
      const auto& [to_s, to] = points[i];
      if (time_s < to_s) return std::lerp(from, to, (time_s - from_s) / (to_s - from_s));
    }
    return points.back().second;
  };
}

}  // namespace cslam
