// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/atlas_io/map_export.h"

#include "cslam/util/check.h"
#include "cslam/vision/pixel_rays.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

namespace cslam {
namespace {

constexpr std::array<std::uint8_t, 3> kGrey = {128, 128, 128};

std::vector<const Keyframe*> KeyframesOf(const MapView& map, MapId map_id) {
  std::vector<const Keyframe*> keyframes;
  for (const KeyframeId id : map.Keyframes()) {
    const Keyframe* const keyframe = map.FindKeyframe(id);
    if (keyframe->map == map_id) keyframes.push_back(keyframe);
  }
  return keyframes;
}

// Gathers points cube by cube.
class VoxelGrid {
 public:
  explicit VoxelGrid(double voxel_m) : voxel_m_(voxel_m) {}

  void Add(const Eigen::Vector3d& p_world) {
    const Eigen::Array3d cell = (p_world.array() / voxel_m_).floor() + kOffset;
    if (!((cell >= 0.0).all() && (cell < 2.0 * kOffset).all())) return;
    const Eigen::Array<std::uint64_t, 3, 1> c = cell.cast<std::uint64_t>();
    Voxel& voxel = voxels_[c.x() << (2 * kBits) | c.y() << kBits | c.z()];
    voxel.sum += p_world;
    ++voxel.count;
  }

  // Sorted by cell: the order of a hash map is nobody's business.
  std::vector<ColoredPoint> Means() const {
    std::vector<std::uint64_t> keys;
    keys.reserve(voxels_.size());
    for (const auto& [key, voxel] : voxels_)
      keys.push_back(key);
    std::sort(keys.begin(), keys.end());
    std::vector<ColoredPoint> points;
    points.reserve(keys.size());
    for (const std::uint64_t key : keys) {
      const Voxel& voxel = voxels_.at(key);
      const Eigen::Vector3d mean = voxel.sum / static_cast<double>(voxel.count);
      points.push_back({.position_m = mean.cast<float>(), .rgb = kGrey});
    }
    return points;
  }

 private:
  static constexpr int kBits = 21;  // per axis: 2 million voxels
  static constexpr double kOffset = 1 << (kBits - 1);

  struct Voxel {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    std::uint32_t count = 0;
  };

  double voxel_m_;
  std::unordered_map<std::uint64_t, Voxel> voxels_;
};

void AddDepth(const Keyframe& keyframe, const PixelRays& rays, double max_depth_m,
              VoxelGrid& grid) {
  const cv::Mat& depth_mm = keyframe.data->depth_small_mm;
  for (int v = 0; v < depth_mm.rows; ++v) {
    const auto* row = depth_mm.ptr<std::uint16_t>(v);
    for (int u = 0; u < depth_mm.cols; ++u) {
      const double depth_m = 1e-3 * row[u];
      if (depth_m <= 0.0 || depth_m > max_depth_m) continue;
      grid.Add(keyframe.T_world_camera * Eigen::Vector3d(depth_m * rays.At(u, v)));
    }
  }
}

}  // namespace

std::vector<ColoredPoint> SparseCloud(const MapView& map, MapId map_id) {
  std::vector<ColoredPoint> cloud;
  for (std::size_t i = 0; i < map.num_point_ids(); ++i) {
    const MapPoint* const point = map.FindPoint(PointId(static_cast<std::uint32_t>(i)));
    if (point == nullptr || point->map != map_id) continue;
    cloud.push_back({.position_m = point->p_world.cast<float>(), .rgb = kGrey});
  }
  return cloud;
}

std::vector<ColoredPoint> DenseCloud(const MapView& map, MapId map_id, const Camera& camera,
                                     const DenseCloudOptions& options) {
  CSLAM_CHECK(options.voxel_m > 0.0);
  VoxelGrid grid(options.voxel_m);
  std::optional<PixelRays> rays;
  for (const Keyframe* keyframe : KeyframesOf(map, map_id)) {
    const cv::Size size = keyframe->data->depth_small_mm.size();
    if (size.area() == 0 || size.width > camera.width) continue;
    if (!rays || rays->size() != size) rays.emplace(camera, size);
    AddDepth(*keyframe, *rays, options.max_depth_m, grid);
  }
  return grid.Means();
}

Trajectory KeyframeTrajectory(const MapView& map, MapId map_id) {
  Trajectory trajectory;
  for (const Keyframe* keyframe : KeyframesOf(map, map_id))
    trajectory.push_back({keyframe->data->stamp, keyframe->T_world_camera});
  std::stable_sort(trajectory.begin(), trajectory.end(),
                   [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  const auto end = std::unique(trajectory.begin(), trajectory.end(),
                               [](const auto& a, const auto& b) { return a.stamp == b.stamp; });
  trajectory.erase(end, trajectory.end());
  return trajectory;
}

}  // namespace cslam
