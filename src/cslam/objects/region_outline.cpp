// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/region_outline.h"

#include <opencv2/core.hpp>

#include <utility>

namespace cslam {

bool IsClipped(const DepthRegion& region) {
  constexpr int kMinTouching = 3;  // pixels on the border; fewer may be noise
  int touching = 0;
  const cv::Mat& mask = region.mask;
  for (int u = 0; u < mask.cols; ++u) {
    touching += mask.at<std::uint8_t>(0, u) != 0 ? 1 : 0;
    touching += mask.at<std::uint8_t>(mask.rows - 1, u) != 0 ? 1 : 0;
  }
  for (int v = 0; v < mask.rows; ++v) {
    touching += mask.at<std::uint8_t>(v, 0) != 0 ? 1 : 0;
    touching += mask.at<std::uint8_t>(v, mask.cols - 1) != 0 ? 1 : 0;
  }
  return touching >= kMinTouching;
}

bool IsCovered(const DepthRegion& region, const DepthView& view) {
  constexpr float kNearerM = 0.25F;
  constexpr double kMinShare = 0.06;  // of the region's outline
  int outline = 0;
  int covered = 0;
  for (int v = 1; v + 1 < region.mask.rows; ++v) {
    for (int u = 1; u + 1 < region.mask.cols; ++u) {
      if (region.mask.at<std::uint8_t>(v, u) == 0) continue;
      const float own = view.DepthM(u, v) > 0.0F ? view.DepthM(u, v) : region.median_m;
      for (const auto& [du, dv] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        if (region.mask.at<std::uint8_t>(v + dv, u + du) != 0) continue;
        ++outline;
        const float other = view.DepthM(u + du, v + dv);
        if (other > 0.0F && other < own - kNearerM) ++covered;
      }
    }
  }
  return outline > 0 && covered > kMinShare * outline;
}

double ShareInside(const DepthRegion& region, const DepthRegion& other) {
  if (region.empty() || other.empty() || Intersect(region.box, other.box).empty()) return 0.0;
  return static_cast<double>(cv::countNonZero(region.mask & other.mask)) / region.num_pixels;
}

}  // namespace cslam
