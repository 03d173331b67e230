// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"

#include <Eigen/Core>

#include <cstdint>

namespace cslam {

class OptionList;

struct ObjectFilterOptions {
  double acceleration_sigma_mps2 = 2.0;
  double centre_sigma_m = 0.01;        // of a measured centre at 1 m ...
  double centre_sigma_per_m2 = 0.004;  // ... and its growth with the depth squared
  double clipped_sigma_m = 0.30;       // added where the thing is cut off or covered
  double moving_speed_mps = 0.25;      // the paper's DOC threshold
  double static_speed_mps = 0.12;      // below this a moving thing has come to rest
  double significance = 9.0;           // speed^2 over its variance (chi2, 1 dof, 99.7 %)
  double moving_after_s = 0.10;        // how long it must be fast to be called moving
  double static_after_s = 0.25;        // how long it must be slow to be called static
  double max_static_sigma_mps = 0.20;  // slow counts only if the speed is known so well
};
void Describe(OptionList& list, ObjectFilterOptions& options);

// What the filter knows about an object's motion.
enum class ObjectMotion : std::uint8_t {
  kUnknown,  // not watched long enough
  kStatic,
  kMoving,
};
const char* ToString(ObjectMotion motion);

// Whether an object's surface stands where it stood a moment before: evidence that a cut-off view
// does not spoil, other than the centre of what is seen.
enum class SurfaceMotion : std::uint8_t { kNotKnown, kRests, kMoves };

// A measured centre of an object.
struct CentreMeasurement {
  Eigen::Vector3d centre_camera = Eigen::Vector3d::Zero();  // m
  bool is_clipped = false;  // by the picture's border or by something in front
  Eigen::Matrix3d camera_covariance_m2 = Eigen::Matrix3d::Zero();  // of the camera's position
  SurfaceMotion surface = SurfaceMotion::kNotKnown;
};

// An extended Kalman filter on [position, velocity] in the world (Eqs. 2 to 10 of the paper),
// covariance in Joseph form, with a verdict that has hysteresis. Time comes from the caller.
class ObjectFilter {
 public:
  // Starts at the measurement with P = I (so the first speed is anybody's guess).
  ObjectFilter(const Se3& T_world_camera, const CentreMeasurement& first);

  void Predict(double dt_s, const ObjectFilterOptions& options);
  void Update(const Se3& T_world_camera, const CentreMeasurement& measurement, double since_last_s,
              const ObjectFilterOptions& options);

  // The world has been corrected: T_new_old takes old world coordinates to new ones.
  void MoveWorld(const Se3& T_new_old);

  Eigen::Vector3d position() const { return x_.head<3>(); }  // m, world
  Eigen::Vector3d velocity() const { return x_.tail<3>(); }  // m/s, world
  const Matrix6& covariance() const { return P_; }
  ObjectMotion motion() const { return motion_; }
  int num_updates() const { return num_updates_; }
  double speed_sigma_mps() const;

 private:
  void Judge(const CentreMeasurement& measurement, double since_last_s,
             const ObjectFilterOptions& options);

  Vector6 x_;
  Matrix6 P_ = Matrix6::Identity();
  ObjectMotion motion_ = ObjectMotion::kUnknown;
  double fast_for_s_ = 0.0;
  double slow_for_s_ = 0.0;
  int num_updates_ = 1;
};

}  // namespace cslam
