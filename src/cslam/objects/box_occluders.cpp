// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/box_occluders.h"

#include "cslam/util/options.h"

#include <opencv2/core.hpp>

#include <algorithm>

namespace cslam {
namespace {

constexpr int kBeyondPx = 2;  // how far outside the box a surface has to be there, too
constexpr int kMaxGapPx = 2;  // pixels without a reading that a surface may bridge

// Along a row from outside the box into it.
class RowWalk {
 public:
  RowWalk(const DepthView& view, int v, int outside_u, int direction, double step_ratio)
      : view_(view), v_(v), outside_u_(outside_u), direction_(direction), step_ratio_(step_ratio) {}

  // How many pixels within the box (its edge at kBeyondPx) a surface covers that begins outside
  // and ends before something farther; 0: none does within most_px.
  int LengthOfOccluder(int most_px) const {
    double z = DepthM(0);
    int last = 0;  // pixel on the surface
    for (int i = 1; z > 0.0 && i - last <= kMaxGapPx + 1; ++i) {
      const double next = DepthM(i);
      if (next <= 0.0) continue;
      const double step_m = std::max(kMinStepM, step_ratio_ * z);
      if (next > z + step_m) return std::max(0, last - kBeyondPx + 1);
      if (next < z - step_m || i - kBeyondPx >= most_px) return 0;
      z = next;
      last = i;
    }
    return 0;
  }

 private:
  static constexpr double kMinStepM = 0.03;  // noise of near readings

  double DepthM(int i) const {  // 0 beyond the picture
    const int u = outside_u_ + direction_ * i;
    return u < 0 || u >= view_.depth_mm.cols ? 0.0 : static_cast<double>(view_.DepthM(u, v_));
  }

  const DepthView& view_;
  int v_;
  int outside_u_;
  int direction_;
  double step_ratio_;
};

}  // namespace

void Describe(OptionList& list, BoxOccluderOptions& o) {
  list.Add("enabled", o.enabled,
           "Leave out what reaches into a box from its sides and hides part of the thing.");
  list.Add("max_share", o.max_share, {0.0, 1.0}, "",
           "How much of the box's width it may cover; more, and it is the thing itself.");
}

cv::Mat FindBoxOccluders(const DepthView& view, const cv::Rect& rect, double step_ratio,
                         const BoxOccluderOptions& options) {
  if (!options.enabled) return {};
  cv::Mat mask = cv::Mat::zeros(view.depth_mm.size(), CV_8UC1);
  const int most_px = static_cast<int>(options.max_share * rect.width);
  const int left = rect.x - kBeyondPx;
  const int right = rect.x + rect.width - 1 + kBeyondPx;
  for (int v = rect.y; v < rect.y + rect.height; ++v) {
    const int from_left = RowWalk(view, v, left, 1, step_ratio).LengthOfOccluder(most_px);
    mask(cv::Rect(rect.x, v, from_left, 1)).setTo(255);
    const int from_right = RowWalk(view, v, right, -1, step_ratio).LengthOfOccluder(most_px);
    mask(cv::Rect(rect.x + rect.width - from_right, v, from_right, 1)).setTo(255);
  }
  return cv::countNonZero(mask) == 0 ? cv::Mat() : mask;
}

}  // namespace cslam
