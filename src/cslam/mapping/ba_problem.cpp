// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/ba_problem.h"

#include <cstdint>

namespace cslam {

BaProblem MakeBaProblem(const MapView& map, std::span<const KeyframeId> keyframes,
                        std::span<const PointId> points, const Camera& camera,
                        const DepthOptions& depth, const MeasurementModel& model) {
  BaProblem problem;
  problem.camera = camera;
  problem.baseline_m = depth.baseline_m;
  problem.pose_is_fixed.assign(keyframes.size(), 0);
  std::vector<int> pose_of(map.num_keyframe_ids(), -1);
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    pose_of[keyframes[i].index()] = static_cast<int>(i);
    problem.T_world_camera.push_back(map.FindKeyframe(keyframes[i])->T_world_camera);
  }
  for (const PointId id : points) {
    const MapPoint& point = *map.FindPoint(id);
    const int index = static_cast<int>(problem.p_world.size());
    problem.p_world.push_back(point.p_world);
    for (const PointObservation& o : point.observations) {
      const int pose = pose_of[o.keyframe.index()];
      if (pose < 0) continue;
      const Keyframe& keyframe = *map.FindKeyframe(o.keyframe);
      const Keypoint& keypoint =
          keyframe.data->features.keypoints[static_cast<std::size_t>(o.keypoint)];
      problem.observations.push_back(
          {.pose = pose,
           .point = index,
           .uv_px = keypoint.uv_px.cast<double>(),
           .disparity_px = static_cast<double>(keypoint.disparity_px),
           .information_px = model.information_px(keypoint.octave),
           .information_disparity = model.information_disparity(keypoint.octave)});
    }
  }
  return problem;
}

std::vector<PointId> PointsSeenBy(const MapView& map, std::span<const KeyframeId> keyframes) {
  std::vector<std::uint8_t> is_member(map.num_point_ids(), 0);
  std::vector<PointId> points;
  for (const KeyframeId id : keyframes) {
    for (const PointId point : map.FindKeyframe(id)->points) {
      if (!point.valid() || is_member[point.index()] != 0) continue;
      if (!IsUsable(*map.FindPoint(point))) continue;
      is_member[point.index()] = 1;
      points.push_back(point);
    }
  }
  return points;
}

}  // namespace cslam
