// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/vision/features.h"
#include "cslam/vision/rgbd_frame.h"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace cslam {

class OptionList;

// What a keypoint lies on.
enum class KeypointLabel : std::uint8_t {
  kStatic,   // background
  kMovable,  // a thing that may be moved, and rests now
  kDynamic,  // a person, a thing that moves, or one not yet known to rest: of no use
};

struct KeypointSemantics {
  KeypointLabel label = KeypointLabel::kStatic;
  std::int16_t class_id = -1;  // COCO class, -1 = background
  TrackId track;               // the tracked object it belongs to, if any
};

// A corner as geometry needs it.
struct Keypoint {
  Eigen::Vector2f uv_px;       // undistorted
  Eigen::Vector2f raw_px;      // in the image as recorded
  float depth_m = 0.0F;        // z of the depth reading at the raw pixel; 0 = none
  float disparity_px = -1.0F;  // fx * baseline / depth; -1 = none
  float angle_rad = 0.0F;      // [0, 2 pi)
  std::int32_t octave = 0;

  bool HasDepth() const { return depth_m > 0.0F; }
};

// Buckets keypoints into square cells for neighbourhood queries.
class KeypointGrid {
 public:
  KeypointGrid() = default;
  KeypointGrid(const ImageBounds& bounds, std::span<const Keypoint> keypoints);

  // Calls visit(index) for every keypoint in the cells that a square of half side radius_px
  // around uv_px touches: a superset, in a fixed order.
  template <typename Visitor>
  void VisitNear(const Eigen::Vector2f& uv_px, float radius_px, Visitor&& visit) const {
    if (columns_ == 0) return;
    const int first_column = ClampColumn(uv_px.x() - radius_px);
    const int last_column = ClampColumn(uv_px.x() + radius_px);
    const int first_row = ClampRow(uv_px.y() - radius_px);
    const int last_row = ClampRow(uv_px.y() + radius_px);
    for (int row = first_row; row <= last_row; ++row) {
      const std::size_t begin = cell_begin_[Cell(first_column, row)];
      const std::size_t end = cell_begin_[Cell(last_column, row) + 1];
      for (std::size_t i = begin; i < end; ++i)
        visit(static_cast<int>(members_[i]));
    }
  }

 private:
  static constexpr float kCellPx = 16.0F;
  std::size_t Cell(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  int ClampColumn(float u) const;
  int ClampRow(float v) const;

  float min_u_ = 0.0F;
  float min_v_ = 0.0F;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint32_t> cell_begin_;  // columns * rows + 1 offsets into members_
  std::vector<std::uint16_t> members_;     // keypoint indices, cell by cell
};

// Everything the geometry of one frame needs; arrays of equal length.
struct FrameFeatures {
  std::vector<Keypoint> keypoints;
  std::vector<Descriptor> descriptors;
  std::vector<KeypointSemantics> semantics;
  KeypointGrid grid;

  std::size_t size() const { return keypoints.size(); }
};

// How depth readings become measurements.
struct DepthOptions {
  double baseline_m = 0.08;               // of the virtual stereo pair that depth is expressed in
  double near_baselines = 40.0;           // up to this many baselines one view makes a point
  double disparity_sigma_px = 0.3;        // of a reading's disparity, at pyramid level 0
  double place_disparity_sigma_px = 1.0;  // the same where places are compared
  int edge_radius_px = 4;
  double max_edge_ratio = 0.03;
  double min_depth_m = 0.1;   // readings below are dropped
  double max_depth_m = 20.0;  // readings above are dropped

  double near_depth_m() const { return baseline_m * near_baselines; }
};
void Describe(OptionList& list, DepthOptions& options);

// Undistorts the corners and reads depth at their raw pixels. bounds: UndistortedBounds(camera).
FrameFeatures MeasureFeatures(OrbFeatures orb, const RgbdFrame& frame, const Camera& camera,
                              const ImageBounds& bounds, const DepthOptions& options);

}  // namespace cslam
