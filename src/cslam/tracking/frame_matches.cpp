// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/tracking/frame_matches.h"

#include <algorithm>

namespace cslam {

int CountMatches(const FrameMatches& matches, Landmark::Kind kind) {
  return static_cast<int>(std::count_if(matches.begin(), matches.end(),
                                        [&](const Landmark& m) { return m.kind == kind; }));
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
                            .information_disparity = model.information_disparity(keypoint.octave)});
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
