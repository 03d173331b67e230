// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/navigation/surface_elements.h"

#include <array>
#include <cmath>

namespace cslam {
namespace {

constexpr int kReachPx = 2;           // the neighbours that tell a normal are so far away
constexpr double kSmoothRatio = 0.1;  // a larger step in depth is another surface

}  // namespace

std::vector<const Keyframe*> KeyframesWithDepth(const MapView& map, MapId map_id) {
  std::vector<const Keyframe*> keyframes;
  for (const KeyframeId id : map.Keyframes()) {
    const Keyframe* const keyframe = map.FindKeyframe(id);
    const cv::Mat& depth_mm = keyframe->data->depth_small_mm;
    if (keyframe->map != map_id || depth_mm.empty()) continue;
    const bool is_first = keyframes.empty();
    if (is_first || keyframes.front()->data->depth_small_mm.size() == depth_mm.size()) {
      keyframes.push_back(keyframe);
    }
  }
  return keyframes;
}

std::vector<SurfaceElement> SurfaceElements(const Keyframe& keyframe, const PixelRays& rays,
                                            int step, double max_depth_m) {
  const cv::Mat& depth_mm = keyframe.data->depth_small_mm;
  const Eigen::Matrix3d R_world_camera = keyframe.T_world_camera.R();
  const auto depth_m = [&](int u, int v) { return 1e-3 * depth_mm.at<std::uint16_t>(v, u); };
  const auto point = [&](int u, int v) { return Eigen::Vector3d(depth_m(u, v) * rays.At(u, v)); };
  std::vector<SurfaceElement> elements;
  for (int v = kReachPx; v + kReachPx < depth_mm.rows; v += step) {
    for (int u = kReachPx; u + kReachPx < depth_mm.cols; u += step) {
      const double z = depth_m(u, v);
      if (z <= 0.0 || z > max_depth_m) continue;
      const std::array<double, 4> around{depth_m(u - kReachPx, v), depth_m(u + kReachPx, v),
                                         depth_m(u, v - kReachPx), depth_m(u, v + kReachPx)};
      bool is_smooth = true;
      for (const double other : around)
        is_smooth = is_smooth && other > 0.0 && std::abs(other - z) < kSmoothRatio * z;
      if (!is_smooth) continue;
      const Eigen::Vector3d right = point(u + kReachPx, v) - point(u - kReachPx, v);
      const Eigen::Vector3d down = point(u, v + kReachPx) - point(u, v - kReachPx);
      Eigen::Vector3d normal = right.cross(down);
      const double area_m2 = normal.norm() / (4.0 * kReachPx * kReachPx);
      const Eigen::Vector3d p_camera = point(u, v);
      if (normal.dot(p_camera) > 0.0) normal = -normal;
      elements.push_back({.p_world = keyframe.T_world_camera * p_camera,
                          .normal_world = R_world_camera * normal.normalized(),
                          .area_m2 = area_m2});
    }
  }
  return elements;
}

}  // namespace cslam
