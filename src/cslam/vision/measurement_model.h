// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace cslam {

// How well a keypoint is measured, by pyramid level.
class MeasurementModel {
 public:
  // level_scales: LevelScales(). A corner at level 0 has a standard deviation of 1 px, growing
  // with the level's scale; disparity_sigma_px is that of the depth reading's disparity at level 0.
  MeasurementModel(std::vector<double> level_scales, double disparity_sigma_px)
      : level_scales_(std::move(level_scales)), disparity_sigma_px_(disparity_sigma_px) {}

  const std::vector<double>& level_scales() const { return level_scales_; }
  int num_levels() const { return static_cast<int>(level_scales_.size()); }
  double scale(int octave) const { return level_scales_[static_cast<std::size_t>(octave)]; }

  // The level at which a point shows whose largest recognisable distance is ratio times the
  // present one.
  int PredictOctave(double ratio) const {
    const auto level =
        std::lower_bound(level_scales_.begin(), level_scales_.end(), ratio * (1.0 - 1e-9));
    return std::min(static_cast<int>(level - level_scales_.begin()), num_levels() - 1);
  }

  // 1 / sigma^2 of u and v, px^-2.
  double information_px(int octave) const { return 1.0 / (scale(octave) * scale(octave)); }

  // 1 / sigma^2 of the disparity, px^-2.
  double information_disparity(int octave) const {
    return information_px(octave) / (disparity_sigma_px_ * disparity_sigma_px_);
  }

 private:
  std::vector<double> level_scales_;
  double disparity_sigma_px_;
};

}  // namespace cslam
