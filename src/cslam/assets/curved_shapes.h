// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/sim/scene.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace cslam {

// How a curved surface is cut and covered.
struct CurvedLook {
  int material = 0;
  double period_m = 0.0;  // of the texture along both directions; zero: one period over the whole
  double cell_m = 0.04;   // no triangle's side is much longer
};

// The image of the unit square; normals point along dP/da x dP/db.
Mesh ParametricSurface(const std::function<Eigen::Vector3d(double a, double b)>& point,
                       const CurvedLook& look);

// An ellipsoid; axes: the columns are its half axes (m), right-handed.
Mesh Ellipsoid(const Eigen::Vector3d& centre, const Eigen::Matrix3d& axes, const CurvedLook& look);
Mesh Ellipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& radii_m,
               const CurvedLook& look);

// A surface of revolution about the vertical through `centre`. profile: (radius, height) in m, seen
// from outside when walked through upwards.
Mesh Lathe(const Eigen::Vector3d& centre, const std::vector<Eigen::Vector2d>& profile_m,
           const CurvedLook& look);

// A round bar along a line, with caps.
Mesh Bar(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius_m,
         const CurvedLook& look);

Mesh Join(Mesh first, const Mesh& second);
// mesh moved, and turned inside out, for the other side of something thin.
Mesh Flipped(Mesh mesh, double shift_inwards_m);
Mesh Transformed(Mesh mesh, const Se3& T_b_a);

}  // namespace cslam
