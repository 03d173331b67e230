// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/object_filter.h"

#include "cslam/util/options.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace cslam {

void Describe(OptionList& list, ObjectFilterOptions& o) {
  list.Add("acceleration_sigma", o.acceleration_sigma_mps2, {0.01, 50.0}, "m/s^2",
           "Acceleration that the motion model allows for.");
  list.Add("centre_sigma", o.centre_sigma_m, {0.001, 1.0}, "m",
           "Standard deviation of a measured object centre at 1 m.");
  list.Add("centre_sigma_growth", o.centre_sigma_per_m2, {0.0, 1.0}, "m/m^2",
           "Its growth with the square of the depth.");
  list.Add("clipped_sigma", o.clipped_sigma_m, {0.0, 5.0}, "m",
           "Added to it where the object is cut off by the border or covered.");
  list.Add("moving_speed", o.moving_speed_mps, {0.01, 10.0}, "m/s",
           "Objects faster than this move (the paper's DOC threshold).");
  list.Add("static_speed", o.static_speed_mps, {0.005, 10.0}, "m/s",
           "Objects slower than this rest.");
  list.Add("significance", o.significance, {0.0, 100.0}, "",
           "How much larger than its variance the squared speed of a moving object is at least.");
  list.Add("moving_after", o.moving_after_s, {0.0, 10.0}, "s",
           "How long an object must be fast to be called moving.");
  list.Add("static_after", o.static_after_s, {0.0, 10.0}, "s",
           "How long an object must be slow to be called static.");
  list.Add("max_static_sigma", o.max_static_sigma_mps, {0.01, 10.0}, "m/s",
           "Uncertainty of the speed above which a slow object is not called static.");
}

const char* ToString(ObjectMotion motion) {
  switch (motion) {
    case ObjectMotion::kUnknown:
      return "unknown";
    case ObjectMotion::kStatic:
      return "static";
    case ObjectMotion::kMoving:
      return "moving";
  }
  return "?";
}

ObjectFilter::ObjectFilter(const Se3& T_world_camera, const CentreMeasurement& first) {
  x_ << T_world_camera * first.centre_camera, Eigen::Vector3d::Zero();
}

// Eqs. 3 to 5, with Q from white acceleration noise.
void ObjectFilter::Predict(double dt_s, const ObjectFilterOptions& options) {
  if (dt_s <= 0.0) return;
  Matrix6 F = Matrix6::Identity();
  F.topRightCorner<3, 3>() = dt_s * Eigen::Matrix3d::Identity();
  const double variance = options.acceleration_sigma_mps2 * options.acceleration_sigma_mps2;
  const double dt2 = dt_s * dt_s;
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  Matrix6 Q;
  Q << I * (dt2 * dt2 / 4.0 * variance), I * (dt2 * dt_s / 2.0 * variance),
      I * (dt2 * dt_s / 2.0 * variance), I * (dt2 * variance);
  x_ = F * x_;
  P_ = F * P_ * F.transpose() + Q;
}

// Eqs. 6 to 10; z is the centre seen from the camera, H = [R_camera_world 0].
void ObjectFilter::Update(const Se3& T_world_camera, const CentreMeasurement& measurement,
                          double since_last_s, const ObjectFilterOptions& options) {
  const Eigen::Matrix3d R_camera_world = T_world_camera.R().transpose();
  Eigen::Matrix<double, 3, 6> H = Eigen::Matrix<double, 3, 6>::Zero();
  H.leftCols<3>() = R_camera_world;
  const double depth_m = measurement.centre_camera.z();
  double sigma_m = options.centre_sigma_m + options.centre_sigma_per_m2 * depth_m * depth_m;
  if (measurement.is_clipped) sigma_m += options.clipped_sigma_m;
  const Eigen::Matrix3d R =
      sigma_m * sigma_m * Eigen::Matrix3d::Identity() +
      R_camera_world * measurement.camera_covariance_m2 * R_camera_world.transpose();

  const Eigen::Vector3d predicted = R_camera_world * (position() - T_world_camera.translation);
  const Eigen::Vector3d innovation = measurement.centre_camera - predicted;
  const Eigen::Matrix3d S = H * P_ * H.transpose() + R;
  const Eigen::Matrix<double, 6, 3> K = P_ * H.transpose() * S.inverse();
  x_ += K * innovation;
  const Matrix6 I_KH = Matrix6::Identity() - K * H;
  P_ = I_KH * P_ * I_KH.transpose() + K * R * K.transpose();
  ++num_updates_;
  Judge(measurement, since_last_s, options);
}

// The verdict changes only on lasting evidence. The speed of a cut-off view's centre is none, and a
// surface that stands where it stood overrules any speed.
void ObjectFilter::Judge(const CentreMeasurement& measurement, double since_last_s,
                         const ObjectFilterOptions& options) {
  const double speed = velocity().norm();
  const Eigen::Vector3d direction =
      speed > 1e-9 ? Eigen::Vector3d(velocity() / speed) : Eigen::Vector3d::UnitX();
  const double variance = direction.dot(P_.bottomRightCorner<3, 3>() * direction);
  const bool rests = measurement.surface == SurfaceMotion::kRests;
  const bool moves = measurement.surface == SurfaceMotion::kMoves;
  const bool has_speed = !measurement.is_clipped;
  const bool is_fast = moves || (has_speed && !rests && speed > options.moving_speed_mps &&
                                 speed * speed > options.significance * variance);
  const bool is_slow = rests || (has_speed && !moves && speed < options.static_speed_mps &&
                                 std::sqrt(std::max(0.0, variance)) < options.max_static_sigma_mps);
  fast_for_s_ = is_fast ? fast_for_s_ + since_last_s : 0.0;
  if (is_slow) {
    slow_for_s_ += since_last_s;
  } else if (is_fast) {
    slow_for_s_ = 0.0;
  }
  if (is_fast && fast_for_s_ >= options.moving_after_s) motion_ = ObjectMotion::kMoving;
  if (is_slow && slow_for_s_ >= options.static_after_s) motion_ = ObjectMotion::kStatic;
}

double ObjectFilter::speed_sigma_mps() const {
  return std::sqrt(std::max(0.0, P_.bottomRightCorner<3, 3>().trace() / 3.0));
}

void ObjectFilter::MoveWorld(const Se3& T_new_old) {
  const Eigen::Matrix3d R = T_new_old.R();
  x_.head<3>() = T_new_old * Eigen::Vector3d(x_.head<3>());
  x_.tail<3>() = R * Eigen::Vector3d(x_.tail<3>());
  Matrix6 RR = Matrix6::Zero();
  RR.topLeftCorner<3, 3>() = R;
  RR.bottomRightCorner<3, 3>() = R;
  P_ = RR * P_ * RR.transpose();
}

}  // namespace cslam
