// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace cslam {

// A rigid transform. T_a_b maps coordinates in b to coordinates in a: p_a = T_a_b * p_b.
// Transforms compose by cancelling neighbours: T_a_c = T_a_b * T_b_c.
struct Se3 {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // unit
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();         // metres

  Se3() = default;
  Se3(const Eigen::Quaterniond& q, const Eigen::Vector3d& t)
      : rotation(q.normalized()), translation(t) {}

  Se3 Inverse() const;
  Eigen::Matrix3d R() const { return rotation.toRotationMatrix(); }
  Eigen::Matrix4d Matrix() const;
  bool IsFinite() const { return rotation.coeffs().allFinite() && translation.allFinite(); }
};

Se3 operator*(const Se3& T_a_b, const Se3& T_b_c);
Eigen::Vector3d operator*(const Se3& T_a_b, const Eigen::Vector3d& p_b);

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Tangent vectors are [rotation (rad), translation (m)].
Se3 Exp(const Vector6& tangent);
Vector6 Log(const Se3& T);

// Ad(T): T * Exp(x) == Exp(Ad(T) * x) * T. 6x6, order [rotation, translation].
Matrix6 Adjoint(const Se3& T);

Eigen::Quaterniond ExpSo3(const Eigen::Vector3d& rotation_rad);
Eigen::Vector3d LogSo3(const Eigen::Quaterniond& rotation);
Eigen::Matrix3d Skew(const Eigen::Vector3d& v);

// Rotation angle in radians, in [0, pi].
double AngleOf(const Se3& T);

// Between two poses: rotation angle (rad) and distance of the origins (m) of a and b seen from a.
struct PoseDifference {
  double angle_rad = 0.0;
  double distance_m = 0.0;
};
PoseDifference Difference(const Se3& T_world_a, const Se3& T_world_b);

// Spherical-linear in rotation, linear in translation; alpha 0 gives a, 1 gives b.
Se3 Interpolate(const Se3& a, const Se3& b, double alpha);

}  // namespace cslam
