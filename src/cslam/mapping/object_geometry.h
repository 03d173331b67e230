// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map_object.h"
#include "cslam/objects/depth_region.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cslam {

// Readings of the view inside the region, in the camera frame (m), at most max_count, spread
// evenly.
std::vector<Eigen::Vector3f> PointsOfRegion(const DepthView& view, const DepthRegion& region,
                                            std::size_t max_count);

// The surface with one more view of the object. points: of its region, T_surface_camera * them lie
// in the surface's frame. What is seen there but outside the region speaks against a cell: floor
// and wall that an earlier region had run into.
ObjectSurface WithView(const ObjectSurface& surface, std::span<const Eigen::Vector3f> points,
                       const Se3& T_surface_camera, const DepthView& view,
                       const DepthRegion& region, double tolerance_m);

// Both together; T_surface_other takes the other's frame to the surface's.
ObjectSurface Joined(const ObjectSurface& surface, const ObjectSurface& other,
                     const Se3& T_surface_other);

// The points of cells that were in the object's region at least as often as outside, and not just
// by chance: what a single view has run into counts once there are many.
std::vector<Eigen::Vector3f> TrustedPoints(const ObjectSurface& surface);

// Where a surface is, to ask often what lies on it.
class SurfaceCells {
 public:
  // Of its trusted points; reach_m: about how near a point must be to one of them.
  SurfaceCells(const ObjectSurface& surface, double reach_m);

  // Share of points (in the surface's frame) that are near.
  double ShareOf(std::span<const Eigen::Vector3f> points) const;

 private:
  bool IsNear(const Eigen::Vector3f& p) const;

  const double reach_m_;
  std::vector<std::array<std::int16_t, 3>> cells_;  // sorted
};

// The same for a single question.
double Overlap(const ObjectSurface& surface, std::span<const Eigen::Vector3f> points,
               double reach_m);

// The smallest box of which one axis is up (unit vector), the outermost 2 % left out.
OrientedBox BoxAround(std::span<const Eigen::Vector3f> points, const Eigen::Vector3d& up);

// The middle one of its sides, at least 1 cm: of what is seen from one side the least is too small,
// and the greatest is the first to take in something that is not the thing.
double MiddleSideM(const OrientedBox& box);

// How many times as large the larger one is as the other, by these sides.
double SizeRatio(const OrientedBox& a, const OrientedBox& b);

// points not empty.
Eigen::Vector3d MeanOf(std::span<const Eigen::Vector3f> points);

// The paper's: mean, and box along the axes between the medians of the 5 % smallest and largest
// coordinates. points not empty.
Eigen::Vector3d CentroidOfPoints(std::span<const Eigen::Vector3d> points);
Eigen::AlignedBox3d ExtentOfPoints(std::span<const Eigen::Vector3d> points);

}  // namespace cslam
