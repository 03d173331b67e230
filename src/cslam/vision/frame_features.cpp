// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/vision/frame_features.h"

#include "cslam/util/check.h"
#include "cslam/util/options.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cslam {
namespace {

// A reading is usable when it is finite and in range.
bool IsUsableDepth(float z, const DepthOptions& options) {
  return std::isfinite(z) && z >= static_cast<float>(options.min_depth_m) &&
         z <= static_cast<float>(options.max_depth_m);
}

// Depth at the nearest pixel; 0 where there is none, it is out of range, or the surface breaks
// off within edge_radius_px: colour and depth are not aligned well enough to tell its two sides.
float ReadDepth(const cv::Mat& depth_m, const Corner& corner, const DepthOptions& options) {
  if (depth_m.empty()) return 0.0F;
  const int u = std::clamp(static_cast<int>(std::lround(corner.u)), 0, depth_m.cols - 1);
  const int v = std::clamp(static_cast<int>(std::lround(corner.v)), 0, depth_m.rows - 1);
  const float z = depth_m.at<float>(v, u);
  if (!IsUsableDepth(z, options)) return 0.0F;
  const int r = options.edge_radius_px;
  if (r == 0) return z;
  const float max_step = static_cast<float>(options.max_edge_ratio) * z;
  for (int dv = -r; dv <= r; dv += r) {
    for (int du = -r; du <= r; du += r) {
      const int nu = std::clamp(u + du, 0, depth_m.cols - 1);
      const int nv = std::clamp(v + dv, 0, depth_m.rows - 1);
      const float neighbour = depth_m.at<float>(nv, nu);
      if (IsUsableDepth(neighbour, options) && std::abs(neighbour - z) > max_step) return 0.0F;
    }
  }
  return z;
}

}  // namespace

KeypointGrid::KeypointGrid(const ImageBounds& bounds, std::span<const Keypoint> keypoints)
    : min_u_(static_cast<float>(bounds.min_u)),
      min_v_(static_cast<float>(bounds.min_v)),
      columns_(1 + static_cast<int>((bounds.max_u - bounds.min_u) / static_cast<double>(kCellPx))),
      rows_(1 + static_cast<int>((bounds.max_v - bounds.min_v) / static_cast<double>(kCellPx))) {
  CSLAM_CHECK(keypoints.size() <= std::numeric_limits<std::uint16_t>::max());
  cell_begin_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  std::vector<std::uint32_t> cell_of(keypoints.size());
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const Eigen::Vector2f& uv = keypoints[i].uv_px;
    cell_of[i] = static_cast<std::uint32_t>(Cell(ClampColumn(uv.x()), ClampRow(uv.y())));
    ++cell_begin_[cell_of[i] + 1];
  }
  for (std::size_t c = 1; c < cell_begin_.size(); ++c)
    cell_begin_[c] += cell_begin_[c - 1];
  members_.resize(keypoints.size());
  std::vector<std::uint32_t> next(cell_begin_.begin(), cell_begin_.end() - 1);
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    members_[next[cell_of[i]]++] = static_cast<std::uint16_t>(i);
  }
}

int KeypointGrid::ClampColumn(float u) const {
  return std::clamp(static_cast<int>(std::floor((u - min_u_) / kCellPx)), 0, columns_ - 1);
}

int KeypointGrid::ClampRow(float v) const {
  return std::clamp(static_cast<int>(std::floor((v - min_v_) / kCellPx)), 0, rows_ - 1);
}

void Describe(OptionList& list, DepthOptions& o) {
  list.Add("baseline", o.baseline_m, {0.005, 1.0}, "m",
           "Baseline of the virtual stereo pair in which depth is expressed as disparity.");
  list.Add("near_baselines", o.near_baselines, {5.0, 500.0}, "baselines",
           "Points nearer than this are made from one view, farther ones by triangulation.");
  list.Add("disparity_sigma", o.disparity_sigma_px, {0.01, 100.0}, "px",
           "Standard deviation of a depth reading, as disparity, at pyramid level 0. Corners of "
           "blurred pictures err by more than depth does, and where they lie on one wall they hold "
           "the camera badly.");
  list.Add("place_disparity_sigma", o.place_disparity_sigma_px, {0.01, 100.0}, "px",
           "The same where a view is compared with a place of the map: its points have drifted.");
  list.Add("edge_radius", o.edge_radius_px, {0, 50}, "px",
           "A reading is dropped when the surface breaks off within this distance; 0: never.");
  list.Add("max_edge_ratio", o.max_edge_ratio, {0.001, 10.0}, "",
           "A surface breaks off where neighbouring readings differ by this share of the depth.");
  list.Add("min_depth", o.min_depth_m, {0.0, 10.0}, "m", "Nearer depth readings are dropped.");
  list.Add("max_depth", o.max_depth_m, {0.5, 1000.0}, "m", "Farther depth readings are dropped.");
}

FrameFeatures MeasureFeatures(OrbFeatures orb, const RgbdFrame& frame, const Camera& camera,
                              const ImageBounds& bounds, const DepthOptions& options) {
  FrameFeatures features;
  features.keypoints.reserve(orb.corners.size());
  const double disparity_metres = camera.fx * options.baseline_m;
  for (const Corner& corner : orb.corners) {
    Keypoint keypoint;
    keypoint.raw_px = {corner.u, corner.v};
    keypoint.uv_px = Undistort(camera, keypoint.raw_px.cast<double>()).cast<float>();
    keypoint.depth_m = ReadDepth(frame.depth_m, corner, options);
    if (keypoint.HasDepth()) {
      keypoint.disparity_px =
          static_cast<float>(disparity_metres / static_cast<double>(keypoint.depth_m));
    }
    keypoint.angle_rad = corner.angle_rad;
    keypoint.octave = corner.octave;
    features.keypoints.push_back(keypoint);
  }
  features.descriptors = std::move(orb.descriptors);
  features.semantics.resize(features.keypoints.size());
  features.grid = KeypointGrid(bounds, features.keypoints);
  return features;
}

}  // namespace cslam
