// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/object_geometry.h"

#include "cslam/objects/expected_view.h"
#include "cslam/util/quantile.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace cslam {
namespace {

using Cell = std::array<std::int16_t, 3>;

constexpr std::size_t kNumSamples = 96;
constexpr std::size_t kMaxVoxels = 4000;

Cell CellOf(const Eigen::Vector3f& p, double voxel_m) {
  Cell cell{};
  for (int axis = 0; axis < 3; ++axis) {
    const double index = std::floor(static_cast<double>(p[axis]) / voxel_m);
    cell[static_cast<std::size_t>(axis)] =
        static_cast<std::int16_t>(std::clamp(index, -32000.0, 32000.0));
  }
  return cell;
}

bool IsBefore(const SurfaceVoxel& a, const SurfaceVoxel& b) {
  return a.cell < b.cell;
}

// Cells of one view: each counts once.
std::vector<SurfaceVoxel> CellsOf(std::span<const Eigen::Vector3f> points, const Se3& T,
                                  double voxel_m) {
  std::vector<SurfaceVoxel> all;
  all.reserve(points.size());
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector3f p = (T * point.cast<double>()).cast<float>();
    all.push_back({CellOf(p, voxel_m), p, 1, 0});
  }
  std::stable_sort(all.begin(), all.end(), IsBefore);
  std::vector<SurfaceVoxel> cells;
  for (std::size_t begin = 0; begin < all.size();) {
    std::size_t end = begin;
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    while (end < all.size() && all[end].cell == all[begin].cell)
      sum += all[end++].p;
    cells.push_back({all[begin].cell, sum / static_cast<float>(end - begin), 1, 0});
    begin = end;
  }
  return cells;
}

std::uint16_t Add(std::uint16_t a, std::uint16_t b) {
  return static_cast<std::uint16_t>(std::min(a + b, 60000));
}

// Both sorted by cell.
std::vector<SurfaceVoxel> Union(const std::vector<SurfaceVoxel>& a,
                                const std::vector<SurfaceVoxel>& b) {
  std::vector<SurfaceVoxel> joined;
  joined.reserve(a.size() + b.size());
  std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(joined), IsBefore);
  std::size_t last = 0;
  for (std::size_t i = 1; i < joined.size(); ++i) {
    SurfaceVoxel& kept = joined[last];
    const SurfaceVoxel& next = joined[i];
    if (next.cell != kept.cell) {
      joined[++last] = next;
      continue;
    }
    const auto weight = static_cast<float>(kept.num_inside);
    const auto more = static_cast<float>(next.num_inside);
    if (weight + more > 0.0F) kept.p = (weight * kept.p + more * next.p) / (weight + more);
    kept.num_inside = Add(kept.num_inside, next.num_inside);
    kept.num_outside = Add(kept.num_outside, next.num_outside);
  }
  if (!joined.empty()) joined.resize(last + 1);
  return joined;
}

// Drops what is seen outside the object again and again, and thins out what is too much.
void Clean(std::vector<SurfaceVoxel>& voxels) {
  constexpr int kSureOutside = 3;
  std::erase_if(voxels, [](const SurfaceVoxel& v) {
    return v.num_outside >= kSureOutside && v.num_outside > 2 * v.num_inside;
  });
  if (voxels.size() <= kMaxVoxels) return;
  std::erase_if(voxels, [](const SurfaceVoxel& v) { return v.num_inside < 2; });
}

template <typename T>
std::vector<T> SpreadEvenly(std::span<const T> all, std::size_t max_count) {
  if (all.size() <= max_count) return {all.begin(), all.end()};
  std::vector<T> some;
  some.reserve(max_count);
  for (std::size_t i = 0; i < max_count; ++i)
    some.push_back(all[i * all.size() / max_count]);
  return some;
}

void CountOutside(std::vector<SurfaceVoxel>& voxels, const Se3& T_camera_surface,
                  const DepthView& view, const DepthRegion& region, double tolerance_m) {
  for (SurfaceVoxel& voxel : voxels) {
    const Eigen::Vector3d p = T_camera_surface * voxel.p.cast<double>();
    const auto pixel = PixelOfSurface(view, p, tolerance_m);
    if (!pixel || region.mask.at<std::uint8_t>(*pixel) != 0) continue;
    voxel.num_outside = Add(voxel.num_outside, 1);
  }
}

// How far they reach along the axis.
ValueRange<double> RobustRange(std::span<const Eigen::Vector3f> points,
                               const Eigen::Vector3d& axis) {
  constexpr double kLeftOut = 0.02;
  std::vector<double> values;
  values.reserve(points.size());
  for (const Eigen::Vector3f& p : points)
    values.push_back(axis.dot(p.cast<double>()));
  const auto num_out = static_cast<std::size_t>(kLeftOut * static_cast<double>(values.size()));
  return InnerRange(std::move(values), num_out);
}

// Readings between two surfaces, as sensors make them at edges, have few neighbours at their depth.
bool IsOnSurface(const DepthView& view, int u, int v) {
  constexpr int kMinNeighbours = 4;  // of 8
  const float z = view.DepthM(u, v);
  if (z <= 0.0F) return false;
  const float step = std::max(0.03F, 0.03F * z);
  int num_near = -1;  // itself
  for (int nv = std::max(v - 1, 0); nv <= std::min(v + 1, view.depth_mm.rows - 1); ++nv) {
    for (int nu = std::max(u - 1, 0); nu <= std::min(u + 1, view.depth_mm.cols - 1); ++nu)
      num_near += std::abs(view.DepthM(nu, nv) - z) <= step ? 1 : 0;
  }
  return num_near >= kMinNeighbours;
}

}  // namespace

std::vector<Eigen::Vector3f> PointsOfRegion(const DepthView& view, const DepthRegion& region,
                                            std::size_t max_count) {
  std::vector<cv::Point> pixels;
  pixels.reserve(static_cast<std::size_t>(region.num_pixels));
  const cv::Rect box = cv::boundingRect(region.mask);
  for (int v = box.y; v < box.br().y; ++v) {
    for (int u = box.x; u < box.br().x; ++u) {
      if (region.mask.at<std::uint8_t>(v, u) != 0 && IsOnSurface(view, u, v))
        pixels.emplace_back(u, v);
    }
  }
  std::vector<Eigen::Vector3f> points;
  for (const cv::Point& pixel : SpreadEvenly<cv::Point>(pixels, max_count)) {
    const auto z_m = static_cast<double>(view.DepthM(pixel.x, pixel.y));
    points.push_back(view.PointAt(pixel.x, pixel.y, z_m).cast<float>());
  }
  return points;
}

ObjectSurface WithView(const ObjectSurface& surface, std::span<const Eigen::Vector3f> points,
                       const Se3& T_surface_camera, const DepthView& view,
                       const DepthRegion& region, double tolerance_m) {
  ObjectSurface next;
  next.voxel_m = surface.voxel_m;
  std::vector<SurfaceVoxel> known = surface.voxels;
  CountOutside(known, T_surface_camera.Inverse(), view, region, tolerance_m);
  next.voxels = Union(known, CellsOf(points, T_surface_camera, surface.voxel_m));
  Clean(next.voxels);
  next.samples = SpreadEvenly<Eigen::Vector3f>(TrustedPoints(next), kNumSamples);
  return next;
}

ObjectSurface Joined(const ObjectSurface& surface, const ObjectSurface& other,
                     const Se3& T_surface_other) {
  std::vector<SurfaceVoxel> moved;
  moved.reserve(other.voxels.size());
  for (SurfaceVoxel voxel : other.voxels) {
    voxel.p = (T_surface_other * voxel.p.cast<double>()).cast<float>();
    voxel.cell = CellOf(voxel.p, surface.voxel_m);
    moved.push_back(voxel);
  }
  std::stable_sort(moved.begin(), moved.end(), IsBefore);
  ObjectSurface joined;
  joined.voxel_m = surface.voxel_m;
  joined.voxels = Union(surface.voxels, Union(moved, {}));
  Clean(joined.voxels);
  joined.samples = SpreadEvenly<Eigen::Vector3f>(TrustedPoints(joined), kNumSamples);
  return joined;
}

std::vector<Eigen::Vector3f> TrustedPoints(const ObjectSurface& surface) {
  constexpr double kUsual = 0.9;     // quantile of how often cells are seen
  constexpr double kMinShare = 0.1;  // of that
  constexpr int kEnough = 4;         // views that always suffice
  std::vector<double> counts;
  counts.reserve(surface.voxels.size());
  for (const SurfaceVoxel& voxel : surface.voxels)
    counts.push_back(voxel.num_inside);
  if (counts.empty()) return {};
  const double usual = QuantileOf(std::move(counts), kUsual);
  const int min_inside = std::clamp(static_cast<int>(std::lround(kMinShare * usual)), 1, kEnough);
  std::vector<Eigen::Vector3f> points;
  points.reserve(surface.voxels.size());
  for (const SurfaceVoxel& voxel : surface.voxels) {
    if (voxel.num_inside >= min_inside && voxel.num_inside >= voxel.num_outside) {
      points.push_back(voxel.p);
    }
  }
  return points;
}

SurfaceCells::SurfaceCells(const ObjectSurface& surface, double reach_m) : reach_m_(reach_m) {
  for (const Eigen::Vector3f& p : TrustedPoints(surface)) {
    const Cell cell = CellOf(p, reach_m);
    if (cells_.empty() || cells_.back() != cell) cells_.push_back(cell);
  }
  std::sort(cells_.begin(), cells_.end());
  cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
}

// The three along the last axis follow each other.
bool SurfaceCells::IsNear(const Eigen::Vector3f& p) const {
  const Cell cell = CellOf(p, reach_m_);
  for (int i = 0; i < 9; ++i) {
    const auto x = static_cast<std::int16_t>(cell[0] + i / 3 - 1);
    const auto y = static_cast<std::int16_t>(cell[1] + i % 3 - 1);
    const Cell from{x, y, static_cast<std::int16_t>(cell[2] - 1)};
    const Cell to{x, y, static_cast<std::int16_t>(cell[2] + 1)};
    const auto found = std::lower_bound(cells_.begin(), cells_.end(), from);
    if (found != cells_.end() && *found <= to) return true;
  }
  return false;
}

double SurfaceCells::ShareOf(std::span<const Eigen::Vector3f> points) const {
  if (points.empty() || cells_.empty()) return 0.0;
  const auto num_near =
      std::count_if(points.begin(), points.end(), [&](const auto& p) { return IsNear(p); });
  return static_cast<double>(num_near) / static_cast<double>(points.size());
}

double Overlap(const ObjectSurface& surface, std::span<const Eigen::Vector3f> points,
               double reach_m) {
  return SurfaceCells(surface, reach_m).ShareOf(points);
}

OrientedBox BoxAround(std::span<const Eigen::Vector3f> points, const Eigen::Vector3d& up) {
  constexpr int kStepDeg = 5;
  constexpr std::size_t kMaxToTurn = 128;  // points that tell how it is turned; all tell its size
  if (points.empty()) return {};
  const std::vector<Eigen::Vector3f> some = SpreadEvenly<Eigen::Vector3f>(points, kMaxToTurn);
  const Eigen::Vector3d first = up.unitOrthogonal();
  const Eigen::Vector3d second = up.cross(first);
  double least_area = std::numeric_limits<double>::max();
  Eigen::Matrix3d axes;
  for (int degrees = 0; degrees < 90; degrees += kStepDeg) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const Eigen::Vector3d x = std::cos(angle) * first + std::sin(angle) * second;
    const Eigen::Vector3d y = up.cross(x);
    const double area = RobustRange(some, x).length() * RobustRange(some, y).length();
    if (area >= least_area) continue;
    least_area = area;
    axes << x, y, up;
  }
  OrientedBox box;
  Eigen::Vector3d middle;
  for (int axis = 0; axis < 3; ++axis) {
    const auto range = RobustRange(points, axes.col(axis));
    box.size_m[axis] = range.length();
    middle[axis] = range.middle();
  }
  box.rotation = Eigen::Quaterniond(axes);
  box.center = axes * middle;
  return box;
}

double MiddleSideM(const OrientedBox& box) {
  Eigen::Vector3d size = box.size_m;
  std::sort(size.begin(), size.end());
  return std::max(size[1], 0.01);
}

double SizeRatio(const OrientedBox& a, const OrientedBox& b) {
  const double ratio = MiddleSideM(a) / MiddleSideM(b);
  return std::max(ratio, 1.0 / ratio);
}

Eigen::Vector3d MeanOf(std::span<const Eigen::Vector3f> points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& p : points)
    sum += p.cast<double>();
  return sum / static_cast<double>(points.size());
}

Eigen::Vector3d CentroidOfPoints(std::span<const Eigen::Vector3d> points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points)
    sum += p;
  return sum / static_cast<double>(points.size());
}

Eigen::AlignedBox3d ExtentOfPoints(std::span<const Eigen::Vector3d> points) {
  constexpr double kShare = 0.05;
  Eigen::AlignedBox3d box;
  Eigen::Vector3d min;
  Eigen::Vector3d max;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    values.reserve(points.size());
    for (const Eigen::Vector3d& p : points)
      values.push_back(p[axis]);
    const std::size_t count = std::max<std::size_t>(
        1, static_cast<std::size_t>(kShare * static_cast<double>(values.size())));
    const std::size_t left_out = (count - 1) / 2;
    const std::size_t last = values.size() - 1;
    min[axis] = ValueOfRank(values, left_out);
    max[axis] = ValueOfRank(std::move(values), last - left_out);
  }
  return {min, max};
}

}  // namespace cslam
