// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"

#include <Eigen/Core>

namespace cslam {

// A point nearer to the image plane than this counts as behind the camera.
inline constexpr double kMinProjectionDepth = 1e-3;  // metres

// What an RGB-D camera measures of a point, [u, v, disparity] in px: its pixel in the image and,
// for the depth reading, the disparity fx * baseline / z to a virtual second camera.
class PixelDisparityModel {
 public:
  PixelDisparityModel(const Camera& camera, double baseline_m);

  // The caller has checked p_camera.z() >= kMinProjectionDepth.
  Eigen::Vector3d Predict(const Eigen::Vector3d& p_camera) const {
    const double inverse_z = 1.0 / p_camera.z();
    return {fx_ * p_camera.x() * inverse_z + cx_, fy_ * p_camera.y() * inverse_z + cy_,
            fx_baseline_ * inverse_z};
  }

  // 3x3, rows [u, v, disparity], columns p_camera.
  Eigen::Matrix3d Jacobian(const Eigen::Vector3d& p_camera) const {
    const double inverse_z = 1.0 / p_camera.z();
    const double inverse_z2 = inverse_z * inverse_z;
    Eigen::Matrix3d jacobian;
    jacobian << fx_ * inverse_z, 0.0, -fx_ * p_camera.x() * inverse_z2,  //
        0.0, fy_ * inverse_z, -fy_ * p_camera.y() * inverse_z2,          //
        0.0, 0.0, -fx_baseline_ * inverse_z2;
    return jacobian;
  }

  double fx() const { return fx_; }
  double fy() const { return fy_; }
  double cx() const { return cx_; }
  double cy() const { return cy_; }
  double fx_baseline() const { return fx_baseline_; }  // px * m

 private:
  double fx_, fy_, cx_, cy_, fx_baseline_;
};

// A measurement [u, v, disparity] with the square roots of its information. Without a depth
// reading the disparity has information 0.
struct Measurement {
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  Eigen::Vector3d sqrt_information = Eigen::Vector3d::Zero();
  bool has_disparity = false;
  bool is_usable = false;  // finite, and with a positive information
};

Measurement MakeMeasurement(const Eigen::Vector2d& uv_px, double disparity_px,
                            double information_px, double information_disparity);

// For PoseObservation and BaObservation.
template <typename Observation>
Measurement MeasurementOf(const Observation& o) {
  return MakeMeasurement(o.uv_px, o.disparity_px, o.information_px, o.information_disparity);
}

// Squared error in units of sigma; infinite if the measurement is not usable or the point is
// behind the camera or not finite.
double Chi2(const PixelDisparityModel& model, const Measurement& measurement,
            const Eigen::Vector3d& p_camera);

// Huber's cost of a squared error: chi2 up to the threshold, linear in its root beyond.
double HuberCost(double chi2, double threshold);

}  // namespace cslam
