// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/eval/plot_data.h"

#include "cslam/util/quantile.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cslam {
namespace {

constexpr std::size_t kMaxPoints = 4000;  // beyond, a screen shows no difference

struct Plane {
  int right = 0;  // coordinate indices
  int up = 1;
};

// The plane of the two widest axes, in the order x, y, z, so that it is seen from above.
Plane WidestPlane(const Trajectory& trajectory) {
  Eigen::Array3d low = trajectory.front().T_world_camera.translation;
  Eigen::Array3d high = low;
  for (const StampedPose& pose : trajectory) {
    low = low.min(pose.T_world_camera.translation.array());
    high = high.max(pose.T_world_camera.translation.array());
  }
  int narrowest = 0;
  (high - low).minCoeff(&narrowest);
  return {narrowest == 0 ? 1 : 0, narrowest == 2 ? 1 : 2};
}

Trajectory Within(const Trajectory& trajectory, Stamp first, Stamp last) {
  Trajectory part;
  std::copy_if(trajectory.begin(), trajectory.end(), std::back_inserter(part),
               [&](const StampedPose& pose) { return first <= pose.stamp && pose.stamp <= last; });
  return part;
}

Trajectory InFirstCamera(const Trajectory& trajectory) {
  const Se3 T_first_world = trajectory.front().T_world_camera.Inverse();
  Trajectory moved;
  for (const auto& [stamp, T_world_camera] : trajectory)
    moved.push_back({stamp, T_first_world * T_world_camera});
  return moved;
}

template <typename T>
std::vector<T> Thinned(const std::vector<T>& all) {
  const std::size_t stride = (all.size() + kMaxPoints - 1) / kMaxPoints;
  if (stride <= 1) return all;
  std::vector<T> kept;
  for (std::size_t i = 0; i < all.size(); i += stride)
    kept.push_back(all[i]);
  if ((all.size() - 1) % stride != 0) kept.push_back(all.back());
  return kept;
}

std::vector<PlotPoint> Project(const Trajectory& trajectory, const Plane& plane, Stamp start) {
  std::vector<PlotPoint> points;
  for (const auto& [stamp, T_world_camera] : trajectory) {
    PlotPoint point;
    point.time_s = SecondsBetween(stamp, start);
    point.top_m = {T_world_camera.translation[plane.right], T_world_camera.translation[plane.up]};
    points.push_back(point);
  }
  return points;
}

// Errors of matched poses, NaN for the others; both are in order of time.
std::vector<PlotPoint> WithErrors(std::vector<PlotPoint> points, const Trajectory& estimate,
                                  const AteResult& ate) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& pairs = ate.association.pairs;
    while (next < pairs.size() && pairs[next].stamp < estimate[i].stamp)
      ++next;
    if (next < pairs.size() && pairs[next].stamp == estimate[i].stamp)
      points[i].value_m = ate.errors_m[next];
  }
  return points;
}

// A pause much longer than the usual step of time.
double LongestStep(const std::vector<PlotPoint>& points) {
  constexpr double kShortestGapS = 0.5;
  std::vector<double> steps_s;
  for (std::size_t i = 1; i < points.size(); ++i)
    steps_s.push_back(points[i].time_s - points[i - 1].time_s);
  if (steps_s.empty()) return kShortestGapS;
  return std::max(kShortestGapS, 5.0 * MedianOf(std::move(steps_s)));
}

std::vector<std::vector<PlotPoint>> SplitAtGaps(const std::vector<PlotPoint>& points) {
  const double longest_s = LongestStep(points);
  std::vector<std::vector<PlotPoint>> pieces;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i == 0 || points[i].time_s - points[i - 1].time_s > longest_s) pieces.emplace_back();
    pieces.back().push_back(points[i]);
  }
  return pieces;
}

PlotData PrepareWithReference(const TrajectoryPlot& plot, const AteResult& ate) {
  constexpr std::array<const char*, 3> kAxes = {"x [m]", "y [m]", "z [m]"};
  const Stamp start = plot.estimate.front().stamp;
  Trajectory reference = Within(plot.reference, start, plot.estimate.back().stamp);
  if (reference.size() < 2) reference = plot.reference;
  const Plane plane = WidestPlane(reference);
  PlotData data;
  data.has_error = true;
  data.right_axis = kAxes[static_cast<std::size_t>(plane.right)];
  data.up_axis = kAxes[static_cast<std::size_t>(plane.up)];
  data.reference = Thinned(Project(reference, plane, start));
  const std::vector<PlotPoint> points = Project(Align(ate.alignment, plot.estimate), plane, start);
  data.estimate = SplitAtGaps(Thinned(WithErrors(points, plot.estimate, ate)));
  return data;
}

PlotData PrepareAlone(const Trajectory& estimate) {
  const Trajectory seen = InFirstCamera(estimate);
  std::vector<PlotPoint> points = Project(seen, {.right = 0, .up = 2}, seen.front().stamp);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i].value_m = -seen[i].T_world_camera.translation.y();  // y of a camera is down
  PlotData data;
  data.right_axis = "right of the first camera [m]";
  data.up_axis = "ahead of the first camera [m]";
  data.estimate = SplitAtGaps(Thinned(points));
  return data;
}

}  // namespace

PlotData PreparePlot(const TrajectoryPlot& plot) {
  if (plot.estimate.empty()) return PlotData{};
  if (plot.ate && !plot.reference.empty()) return PrepareWithReference(plot, *plot.ate);
  return PrepareAlone(plot.estimate);
}

}  // namespace cslam
