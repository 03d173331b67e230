// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/colour_histogram.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <numeric>

namespace cslam {
namespace {

constexpr int kBins = 8;
constexpr int kColouredFrom = 40;  // saturation (0 to 255) below which a hue means nothing

// Where a pixel is counted: hue (-1: it has none), saturation and value.
struct Bins {
  int hue = -1;
  int saturation = 0;
  int value = 0;
};
Bins BinsOf(const cv::Vec3b& hsv) {
  return {hsv[1] >= kColouredFrom ? hsv[0] * kBins / 180 : -1, kBins + hsv[1] * kBins / 256,
          2 * kBins + hsv[2] * kBins / 256};
}

}  // namespace

ColourHistogram ColoursOf(const cv::Mat& bgr, const DepthRegion& region) {
  return region.empty() ? ColourHistogram{} : ColoursOf(bgr, region.mask);
}

ColourHistogram ColoursOf(const cv::Mat& bgr, const cv::Mat& mask) {
  ColourHistogram histogram{};
  if (bgr.empty() || mask.empty()) return histogram;
  cv::Mat small;
  cv::resize(bgr, small, mask.size(), 0.0, 0.0, cv::INTER_NEAREST);
  cv::cvtColor(small, small, cv::COLOR_BGR2HSV);
  float hues = 0.0F;
  float pixels = 0.0F;
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      if (mask.at<std::uint8_t>(v, u) == 0) continue;
      const Bins bins = BinsOf(small.at<cv::Vec3b>(v, u));
      if (bins.hue >= 0) {
        histogram[static_cast<std::size_t>(bins.hue)] += 1.0F;
        hues += 1.0F;
      }
      histogram[static_cast<std::size_t>(bins.saturation)] += 1.0F;
      histogram[static_cast<std::size_t>(bins.value)] += 1.0F;
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

cv::Mat PixelsOfColours(const cv::Mat& bgr, const ColourHistogram& colours, float min_share) {
  std::array<bool, 3 * kBins> is_common{};
  for (int i = 0; i < 3 * kBins; ++i) {
    const int first = i / kBins * kBins;
    const auto share = [&](int bin) {
      if (first == 0) bin = (bin + kBins) % kBins;  // hues go round
      return bin < first || bin >= first + kBins ? 0.0F : colours[static_cast<std::size_t>(bin)];
    };
    is_common[static_cast<std::size_t>(i)] = share(i - 1) + share(i) + share(i + 1) >= min_share;
  }
  cv::Mat hsv;
  cv::cvtColor(bgr, hsv, cv::COLOR_BGR2HSV);
  cv::Mat like(bgr.size(), CV_8UC1, cv::Scalar(0));
  for (int v = 0; v < hsv.rows; ++v) {
    for (int u = 0; u < hsv.cols; ++u) {
      const Bins bins = BinsOf(hsv.at<cv::Vec3b>(v, u));
      const bool is_like = (bins.hue < 0 || is_common[static_cast<std::size_t>(bins.hue)]) &&
                           is_common[static_cast<std::size_t>(bins.saturation)] &&
                           is_common[static_cast<std::size_t>(bins.value)];
      if (is_like) like.at<std::uint8_t>(v, u) = 255;
    }
  }
  return like;
}

}  // namespace cslam
