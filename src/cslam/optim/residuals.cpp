// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/optim/residuals.h"

#include <cmath>
#include <limits>

namespace cslam {

PixelDisparityModel::PixelDisparityModel(const Camera& camera, double baseline_m)
    : fx_(camera.fx),
      fy_(camera.fy),
      cx_(camera.cx),
      cy_(camera.cy),
      fx_baseline_(camera.fx * baseline_m) {}

Measurement MakeMeasurement(const Eigen::Vector2d& uv_px, double disparity_px,
                            double information_px, double information_disparity) {
  Measurement m;
  m.is_usable = uv_px.allFinite() && std::isfinite(information_px) && information_px > 0.0;
  if (!m.is_usable) return m;
  const double sqrt_information_px = std::sqrt(information_px);
  m.value.head<2>() = uv_px;
  m.sqrt_information.head<2>().setConstant(sqrt_information_px);
  m.has_disparity = std::isfinite(disparity_px) && disparity_px >= 0.0 &&
                    std::isfinite(information_disparity) && information_disparity > 0.0;
  if (m.has_disparity) {
    m.value.z() = disparity_px;
    m.sqrt_information.z() = std::sqrt(information_disparity);
  }
  return m;
}

double Chi2(const PixelDisparityModel& model, const Measurement& measurement,
            const Eigen::Vector3d& p_camera) {
  const bool is_in_front = p_camera.z() >= kMinProjectionDepth;  // false for NaN
  if (!measurement.is_usable || !is_in_front || !p_camera.allFinite()) {
    return std::numeric_limits<double>::infinity();
  }
  const Eigen::Vector3d error = model.Predict(p_camera) - measurement.value;
  return error.cwiseProduct(measurement.sqrt_information).squaredNorm();
}

double HuberCost(double chi2, double threshold) {
  return chi2 <= threshold ? chi2 : 2.0 * std::sqrt(threshold * chi2) - threshold;
}

}  // namespace cslam
