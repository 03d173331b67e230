// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/geometry/se3.h"
#include "cslam/util/stamp.h"

#include <opencv2/core/mat.hpp>

#include <cstddef>
#include <optional>

namespace cslam {

// The frames of a sequence as its checks see them, be they files (check_folder.h) or rendered when
// asked for. 0 <= i < size().
class CheckFrames {
 public:
  virtual ~CheckFrames() = default;

  virtual std::size_t size() const = 0;
  virtual const Camera& camera() const = 0;
  virtual Stamp stamp(std::size_t i) const = 0;  // of the colour image

  // True pose when depth was taken; nothing where there is none.
  virtual std::optional<Se3> T_world_camera(std::size_t i) const = 0;

  // H x W, CV_32FC1, m, 0 = no reading; an empty image if it cannot be read.
  virtual cv::Mat DepthM(std::size_t i) const = 0;

  // Whether there are instance images at all.
  virtual bool has_instances() const = 0;
  // H x W, CV_16UC1; an empty image if there is none or it cannot be read.
  virtual cv::Mat Instances(std::size_t i) const = 0;
};

// How far depth may be from the truth: |error| <= floor_m + per_square * z^2 for 95 % of the
// readings (z in m).
struct DepthTolerance {
  double floor_m = 0.001;
  double per_square = 0.0;  // 1/m

  double At(double z_m) const { return floor_m + per_square * z_m * z_m; }
};

}  // namespace cslam
