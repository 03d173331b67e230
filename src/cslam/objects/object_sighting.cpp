// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/object_sighting.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <numeric>

namespace cslam {
namespace {

constexpr int kBins = 8;
constexpr int kColouredFrom = 40;  // saturation (0 to 255) below which a hue means nothing

}  // namespace

cv::Mat CoveredByOthers(std::span<const ObjectSighting> sightings, int class_id,
                        const ObjectClasses& classes) {
  cv::Mat covered;
  for (const ObjectSighting& sighting : sightings) {
    if (classes.AreAlike(sighting.class_id, class_id)) continue;
    covered = covered.empty() ? sighting.region.mask : cv::Mat(covered | sighting.region.mask);
  }
  return covered;
}

ColourHistogram ColoursOf(const cv::Mat& bgr, const DepthRegion& region) {
  ColourHistogram histogram{};
  if (bgr.empty() || region.empty()) return histogram;
  cv::Mat small;
  cv::resize(bgr, small, region.mask.size(), 0.0, 0.0, cv::INTER_NEAREST);
  cv::cvtColor(small, small, cv::COLOR_BGR2HSV);
  float hues = 0.0F;
  float pixels = 0.0F;
  for (int v = 0; v < small.rows; ++v) {
    for (int u = 0; u < small.cols; ++u) {
      if (region.mask.at<std::uint8_t>(v, u) == 0) continue;
      const auto& hsv = small.at<cv::Vec3b>(v, u);
      if (hsv[1] >= kColouredFrom) {
        histogram[static_cast<std::size_t>(hsv[0] * kBins / 180)] += 1.0F;
        hues += 1.0F;
      }
      histogram[static_cast<std::size_t>(kBins + hsv[1] * kBins / 256)] += 1.0F;
      histogram[static_cast<std::size_t>(2 * kBins + hsv[2] * kBins / 256)] += 1.0F;
      pixels += 1.0F;
    }
  }
  for (std::size_t i = 0; i < histogram.size(); ++i) {
    const float sum = i < kBins ? hues : pixels;
    if (sum > 0.0F) histogram[i] /= sum;
  }
  return histogram;
}

double ColourLikeness(const ColourHistogram& a, const ColourHistogram& b) {
  const auto is_empty = [](const ColourHistogram& h) {
    return std::accumulate(h.begin(), h.end(), 0.0F) <= 0.0F;
  };
  if (is_empty(a) || is_empty(b)) return 0.5;
  double common = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    common += static_cast<double>(std::min(a[i], b[i]));
    total += 0.5 * static_cast<double>(a[i] + b[i]);
  }
  return common / total;
}

}  // namespace cslam
