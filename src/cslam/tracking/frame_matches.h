// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map_view.h"
#include "cslam/optim/pose_optimizer.h"
#include "cslam/vision/measurement_model.h"

#include <vector>

namespace cslam {

// What a keypoint was matched with.
struct Landmark {
  enum class Kind : std::uint8_t {
    kNone,
    kMapPoint,
    kProvisional,  // a depth reading of the last frame, not in the map (yet)
  };
  Kind kind = Kind::kNone;
  PointId point;              // of a map point
  bool is_held_back = false;  // by its object: no part of a pose while the room suffices
  Eigen::Vector3d p_world = Eigen::Vector3d::Zero();
  double weight = 1.0;  // its say in a pose
};

using FrameMatches = std::vector<Landmark>;  // one per keypoint

// Whether the keypoint's depth alone makes a landmark of it.
bool IsNear(const Keypoint& keypoint, const DepthOptions& options);

int CountMatches(const FrameMatches& matches, Landmark::Kind kind);

// Takes those of held-back points out of matches. Returns them, kNone elsewhere.
FrameMatches TakeHeldBack(FrameMatches& matches);

struct PoseEstimate;

// Puts those back whose reprojection agrees with the pose (chi2 gates of the options): they are
// seen, though they had no say.
void KeepAgreeing(const FrameMatches& held_back, const FrameFeatures& features,
                  const Camera& camera, double baseline_m, const MeasurementModel& model,
                  const PoseOptimizerOptions& options, PoseEstimate& estimate);

// The ids of the map points, one per keypoint; invalid where there is none.
std::vector<PointId> PointIds(const FrameMatches& matches);

// A pose and the matches it agrees with.
struct PoseEstimate {
  Se3 T_world_camera;
  FrameMatches matches;  // outliers have become kNone
  int num_map_inliers = 0;
  int num_provisional_inliers = 0;

  int num_inliers() const { return num_map_inliers + num_provisional_inliers; }
};

// Motion-only optimisation from T_world_camera. Provisional matches are left out when
// use_provisional is false.
enum class Provisional : std::uint8_t { kIgnore, kUse };
PoseEstimate EstimatePose(const FrameFeatures& features, FrameMatches matches,
                          const Se3& T_world_camera, Provisional provisional, const Camera& camera,
                          double baseline_m, const MeasurementModel& model,
                          const PoseOptimizerOptions& options);

}  // namespace cslam
