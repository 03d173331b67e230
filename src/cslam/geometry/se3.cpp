// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/geometry/se3.h"

#include <cmath>

namespace cslam {
namespace {

constexpr double kSmallAngle = 1e-5;

// V of SE(3): translation = V * tangent translation, for rotation vector w.
Eigen::Matrix3d LeftJacobian(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  const Eigen::Matrix3d W = Skew(w);
  if (angle < kSmallAngle) return Eigen::Matrix3d::Identity() + 0.5 * W + W * W / 6.0;
  const double a2 = angle * angle;
  return Eigen::Matrix3d::Identity() + (1.0 - std::cos(angle)) / a2 * W +
         (angle - std::sin(angle)) / (a2 * angle) * W * W;
}

}  // namespace

Se3 Se3::Inverse() const {
  const Eigen::Quaterniond inverse_rotation = rotation.conjugate();
  return Se3(inverse_rotation, -(inverse_rotation * translation));
}

Eigen::Matrix4d Se3::Matrix() const {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = R();
  matrix.topRightCorner<3, 1>() = translation;
  return matrix;
}

Se3 operator*(const Se3& T_a_b, const Se3& T_b_c) {
  return Se3(T_a_b.rotation * T_b_c.rotation,
             T_a_b.rotation * T_b_c.translation + T_a_b.translation);
}

Eigen::Vector3d operator*(const Se3& T_a_b, const Eigen::Vector3d& p_b) {
  return T_a_b.rotation * p_b + T_a_b.translation;
}

Eigen::Matrix3d Skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d skew;
  skew << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return skew;
}

Eigen::Quaterniond ExpSo3(const Eigen::Vector3d& rotation_rad) {
  const double angle = rotation_rad.norm();
  const double half = 0.5 * angle;
  // sin(x/2)/x; its series where the quotient loses digits.
  const double k = angle < kSmallAngle ? 0.5 - angle * angle / 48.0 : std::sin(half) / angle;
  return Eigen::Quaterniond(std::cos(half), k * rotation_rad.x(), k * rotation_rad.y(),
                            k * rotation_rad.z())
      .normalized();
}

Eigen::Vector3d LogSo3(const Eigen::Quaterniond& rotation) {
  // q and -q are the same rotation; the one with w >= 0 has the angle in [0, pi].
  const double sign = rotation.w() < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector3d v = sign * rotation.vec();
  const double w = sign * rotation.w();
  const double sine = v.norm();
  if (sine < kSmallAngle) return (2.0 / w - 2.0 / 3.0 * sine * sine / (w * w * w)) * v;
  return 2.0 * std::atan2(sine, w) / sine * v;
}

Se3 Exp(const Vector6& tangent) {
  const Eigen::Vector3d w = tangent.head<3>();
  return Se3(ExpSo3(w), LeftJacobian(w) * tangent.tail<3>());
}

Vector6 Log(const Se3& T) {
  Vector6 tangent;
  tangent.head<3>() = LogSo3(T.rotation);
  tangent.tail<3>() = LeftJacobian(tangent.head<3>()).partialPivLu().solve(T.translation);
  return tangent;
}

Matrix6 Adjoint(const Se3& T) {
  const Eigen::Matrix3d R = T.R();
  Matrix6 adjoint = Matrix6::Zero();
  adjoint.topLeftCorner<3, 3>() = R;
  adjoint.bottomRightCorner<3, 3>() = R;
  adjoint.bottomLeftCorner<3, 3>() = Skew(T.translation) * R;
  return adjoint;
}

double AngleOf(const Se3& T) {
  return 2.0 * std::atan2(T.rotation.vec().norm(), std::abs(T.rotation.w()));
}

PoseDifference Difference(const Se3& T_world_a, const Se3& T_world_b) {
  const Se3 T_a_b = T_world_a.Inverse() * T_world_b;
  return {.angle_rad = AngleOf(T_a_b), .distance_m = T_a_b.translation.norm()};
}

Se3 Interpolate(const Se3& a, const Se3& b, double alpha) {
  return Se3(a.rotation.slerp(alpha, b.rotation),
             (1.0 - alpha) * a.translation + alpha * b.translation);
}

}  // namespace cslam
