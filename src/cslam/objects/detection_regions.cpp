// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/detection_regions.h"

#include "cslam/objects/region_outline.h"
#include "cslam/util/quantile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

namespace cslam {
namespace {

// Whether most of a lies within b, which is clearly larger: it sits on it or stands before it.
bool SitsOn(const Box& a, const Box& b) {
  constexpr double kInside = 0.7;
  constexpr double kSmaller = 0.6;
  return a.area() < kSmaller * b.area() && Intersect(a, b).area() > kInside * a.area();
}

// People first, then what sits on something before what it sits on, then nearer things, so that
// those behind leave out what is covered: the box of a chair behind somebody is full of that
// person, and that of a chair with a bear has the bear in the middle.
std::vector<std::size_t> FrontToBack(const std::vector<SegmentedDetection>& detections) {
  std::vector<std::size_t> left(detections.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  std::vector<int> num_on(detections.size());  // of those left that sit on it
  const auto count = [&](std::size_t upper, int change) {
    for (const std::size_t i : left) {
      if (i != upper && SitsOn(detections[upper].detection.box, detections[i].detection.box))
        num_on[i] += change;
    }
  };
  for (const std::size_t i : left)
    count(i, 1);
  const auto rank = [&](std::size_t i) {
    const auto& [detection, region] = detections[i];
    const bool is_person = detection.class_id == kPersonClass;
    const float z = region.empty() ? std::numeric_limits<float>::max() : region.median_m;
    return std::tuple(!is_person, num_on[i] > 0, z, i);
  };
  std::vector<std::size_t> order;
  while (!left.empty()) {
    const auto next = std::min_element(
        left.begin(), left.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
    order.push_back(*next);
    left.erase(next);
    count(order.back(), -1);
  }
  return order;
}

DepthRegion Segment(const DepthView& view, const Detection& detection, const cv::Mat& excluded,
                    const RegionOptions& options) {
  const bool is_person = detection.class_id == kPersonClass;
  return detection.mask.empty()
             ? SegmentBox(view, detection.box, is_person, excluded, options)
             : SegmentMask(view, detection.box, detection.mask, is_person, excluded, options);
}

float MedianDepthM(const DepthView& view, const cv::Mat& mask) {
  std::vector<float> depths_m;
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      const float depth_m = mask.at<std::uint8_t>(v, u) != 0 ? view.DepthM(u, v) : 0.0F;
      if (depth_m > 0.0F) depths_m.push_back(depth_m);
    }
  }
  return depths_m.empty() ? 0.0F : MedianOf(std::move(depths_m));
}

// Whether a is called like b and shows part of the same surface; farther from the rest of b it
// stands before it.
bool IsPieceOf(const SegmentedDetection& a, const SegmentedDetection& b, const DepthView& view) {
  constexpr double kInside = 0.7;
  constexpr float kSameDepthM = 0.3F;
  if (a.detection.class_id != b.detection.class_id || a.detection.class_id == kPersonClass ||
      !SitsOn(a.detection.box, b.detection.box) || ShareInside(a.region, b.region) <= kInside) {
    return false;
  }
  const cv::Mat rest = b.region.mask & ~a.region.mask;
  return std::abs(a.region.median_m - MedianDepthM(view, rest)) < kSameDepthM;
}

// Several pieces of one thing are rather several things, in a box around them all.
std::optional<std::size_t> OnlyPieceOf(const SegmentedDetection& whole,
                                       const std::vector<SegmentedDetection>& detections,
                                       const DepthView& view) {
  std::optional<std::size_t> piece;
  for (std::size_t i = 0; i < detections.size(); ++i) {
    if (!IsPieceOf(detections[i], whole, view)) continue;
    if (piece) return std::nullopt;
    piece = i;
  }
  return piece;
}

std::vector<SegmentedDetection> WithoutPieces(std::vector<SegmentedDetection> detections,
                                              const DepthView& view) {
  std::vector<bool> is_piece(detections.size());
  for (const SegmentedDetection& whole : detections) {
    if (const auto piece = OnlyPieceOf(whole, detections, view)) is_piece[*piece] = true;
  }
  std::vector<SegmentedDetection> wholes;
  for (std::size_t i = 0; i < detections.size(); ++i) {
    if (!is_piece[i]) wholes.push_back(std::move(detections[i]));
  }
  return wholes;
}

}  // namespace

std::vector<SegmentedDetection> SegmentDetections(const DepthView& view,
                                                  const std::vector<Detection>& detections,
                                                  const RegionOptions& options) {
  std::vector<SegmentedDetection> segmented;
  segmented.reserve(detections.size());
  for (const Detection& detection : detections)
    segmented.push_back({detection, Segment(view, detection, {}, options)});
  segmented = WithoutPieces(std::move(segmented), view);
  cv::Mat taken;
  for (const std::size_t i : FrontToBack(segmented)) {
    const Detection& detection = segmented[i].detection;
    const bool overlaps = std::any_of(segmented.begin(), segmented.end(), [&](const auto& other) {
      return &other != &segmented[i] && Iou(other.detection.box, detection.box) > 0.0;
    });
    if (overlaps && !taken.empty()) segmented[i].region = Segment(view, detection, taken, options);
    const DepthRegion& region = segmented[i].region;
    if (region.empty()) continue;
    if (taken.empty()) taken = cv::Mat::zeros(region.mask.size(), CV_8UC1);
    taken.setTo(255, region.mask);
  }
  return segmented;
}

}  // namespace cslam
