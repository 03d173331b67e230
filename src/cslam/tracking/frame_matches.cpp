// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/tracking/frame_matches.h"

#include <algorithm>
#include <utility>

namespace cslam {

bool IsNear(const Keypoint& keypoint, const DepthOptions& options) {
  return keypoint.HasDepth() && static_cast<double>(keypoint.depth_m) < options.near_depth_m();
}

int CountMatches(const FrameMatches& matches, Landmark::Kind kind) {
  return static_cast<int>(std::count_if(matches.begin(), matches.end(),
                                        [&](const Landmark& m) { return m.kind == kind; }));
}

FrameMatches TakeHeldBack(FrameMatches& matches) {
  FrameMatches taken(matches.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (matches[i].is_held_back) taken[i] = std::exchange(matches[i], Landmark{});
  }
  return taken;
}

void KeepAgreeing(const FrameMatches& held_back, const FrameFeatures& features,
                  const Camera& camera, double baseline_m, const MeasurementModel& model,
                  const PoseOptimizerOptions& options, PoseEstimate& estimate) {
  const Se3 T_camera_world = estimate.T_world_camera.Inverse();
  for (std::size_t i = 0; i < held_back.size(); ++i) {
    if (held_back[i].kind == Landmark::Kind::kNone) continue;
    const Keypoint& keypoint = features.keypoints[i];
    const Eigen::Vector3d p_camera = T_camera_world * held_back[i].p_world;
    if (p_camera.z() <= 0.0) continue;
    const Eigen::Vector2d error = Project(camera, p_camera) - keypoint.uv_px.cast<double>();
    double chi2 = error.squaredNorm() * model.information_px(keypoint.octave);
    if (keypoint.HasDepth()) {
      const double disparity_error =
          camera.fx * baseline_m / p_camera.z() - static_cast<double>(keypoint.disparity_px);
      chi2 += disparity_error * disparity_error * model.information_disparity(keypoint.octave);
    }
    if (chi2 <= (keypoint.HasDepth() ? options.chi2_depth : options.chi2_mono)) {
      estimate.matches[i] = held_back[i];
    }
  }
}

std::vector<PointId> PointIds(const FrameMatches& matches) {
  std::vector<PointId> ids(matches.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (matches[i].kind == Landmark::Kind::kMapPoint) ids[i] = matches[i].point;
  }
  return ids;
}

PoseEstimate EstimatePose(const FrameFeatures& features, FrameMatches matches,
                          const Se3& T_world_camera, Provisional provisional, const Camera& camera,
                          double baseline_m, const MeasurementModel& model,
                          const PoseOptimizerOptions& options) {
  std::vector<PoseObservation> observations;
  std::vector<std::size_t> keypoint_of;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (provisional == Provisional::kIgnore && matches[i].kind == Landmark::Kind::kProvisional) {
      matches[i] = Landmark{};
    }
    if (matches[i].kind == Landmark::Kind::kNone) continue;
    const Keypoint& keypoint = features.keypoints[i];
    observations.push_back({.p_world = matches[i].p_world,
                            .uv_px = keypoint.uv_px.cast<double>(),
                            .disparity_px = static_cast<double>(keypoint.disparity_px),
                            .information_px = model.information_px(keypoint.octave),
                            .information_disparity = model.information_disparity(keypoint.octave),
                            .weight = matches[i].weight});
    keypoint_of.push_back(i);
  }
  const PoseSolution solution =
      OptimizePose(camera, baseline_m, T_world_camera, observations, options);

  PoseEstimate estimate;
  estimate.T_world_camera = solution.T_world_camera;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    Landmark& match = matches[keypoint_of[i]];
    if (solution.is_inlier[i] == 0) {
      match = Landmark{};
    } else if (match.kind == Landmark::Kind::kMapPoint) {
      ++estimate.num_map_inliers;
    } else {
      ++estimate.num_provisional_inliers;
    }
  }
  estimate.matches = std::move(matches);
  return estimate;
}

}  // namespace cslam
