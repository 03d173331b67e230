// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/camera_path.h"

#include "cslam/util/check.h"
#include "cslam/util/random.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace cslam {
namespace {

constexpr double kRampS = 0.8;  // from rest to full speed, and back

// Uniform cubic B-spline weights of four neighbouring keys; t in [0, 1].
std::array<double, 4> SplineWeights(double t) {
  const double s = 1.0 - t;
  return {s * s * s / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
          (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0, t * t * t / 6.0};
}

// Share of the path covered at a time: constant speed between two smooth ramps.
double Progress(double time_s, double duration_s) {
  const double ramp_s = std::min(kRampS, 0.5 * duration_s);
  const auto ramp = [&](double t) {  // integral of smoothstep(t / ramp_s)
    const double x = std::clamp(t / ramp_s, 0.0, 1.0);
    return ramp_s * (x * x * x - 0.5 * x * x * x * x);
  };
  const double t = std::clamp(time_s, 0.0, duration_s);
  const double total_s = duration_s - ramp_s;
  if (t < ramp_s) return ramp(t) / total_s;
  if (t > duration_s - ramp_s) return 1.0 - ramp(duration_s - t) / total_s;
  return (t - 0.5 * ramp_s) / total_s;
}

Eigen::Vector3d Wobble(double time_s, Rng rng) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double amplitude : {0.6, 0.3, 0.1}) {
      const double frequency_hz = rng.Uniform(0.2, 0.6) / amplitude * 0.3;
      const double phase_rad = rng.Uniform(0.0, 2.0 * std::numbers::pi);
      sum[axis] += amplitude * std::sin(2.0 * std::numbers::pi * frequency_hz * time_s + phase_rad);
    }
  }
  return sum;
}

}  // namespace

CameraPath::CameraPath(std::vector<PathKey> keys, double duration_s, const HandWobble& wobble)
    : keys_(std::move(keys)), duration_s_(duration_s), wobble_(wobble) {
  CSLAM_CHECK(!keys_.empty() && duration_s > 0.0);
  // Threefold ends make the spline start and stop at the outer keys.
  keys_.insert(keys_.begin(), 2, PathKey(keys_.front()));
  keys_.insert(keys_.end(), 2, PathKey(keys_.back()));
}

PathKey CameraPath::SmoothKey(double time_s) const {
  const auto spans = static_cast<double>(keys_.size() - 3);
  const double at = Progress(time_s, duration_s_) * spans;
  const double first = std::clamp(std::floor(at), 0.0, spans - 1.0);
  const std::array<double, 4> weights = SplineWeights(at - first);
  PathKey mean;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const PathKey& key = keys_[static_cast<std::size_t>(first) + i];
    mean.position += weights[i] * key.position;
    mean.yaw_rad += weights[i] * key.yaw_rad;
    mean.pitch_rad += weights[i] * key.pitch_rad;
  }
  return mean;
}

Se3 CameraPath::T_world_camera(double time_s) const {
  const Eigen::Vector3d shift_m = wobble_.position_m * Wobble(time_s, Rng(wobble_.seed, 0, 1));
  const Eigen::Vector3d turn_rad = wobble_.rotation_rad * Wobble(time_s, Rng(wobble_.seed, 0, 2));
  return PoseAt(SmoothKey(time_s)) * Se3(ExpSo3(turn_rad), shift_m);
}

CameraMotion CameraPath::Motion() const {
  return {duration_s_, [path = *this](double time_s) { return path.T_world_camera(time_s); }};
}

Se3 PoseAt(const PathKey& key) {
  const Eigen::Vector3d forward(std::cos(key.pitch_rad) * std::cos(key.yaw_rad),
                                std::cos(key.pitch_rad) * std::sin(key.yaw_rad),
                                std::sin(key.pitch_rad));
  const Eigen::Vector3d right(std::sin(key.yaw_rad), -std::cos(key.yaw_rad), 0.0);
  Eigen::Matrix3d R_world_camera;
  R_world_camera << right, forward.cross(right), forward;
  return {Eigen::Quaterniond(R_world_camera), key.position};
}

}  // namespace cslam
