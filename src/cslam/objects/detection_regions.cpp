// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/detection_regions.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

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
std::vector<std::size_t> FrontToBack(const std::vector<Detection>& detections,
                                     const std::vector<DepthRegion>& regions) {
  std::vector<std::size_t> left(detections.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  std::vector<int> num_on(detections.size());  // of those left that sit on it
  const auto count = [&](std::size_t upper, int change) {
    for (const std::size_t i : left) {
      if (i != upper && SitsOn(detections[upper].box, detections[i].box)) num_on[i] += change;
    }
  };
  for (const std::size_t i : left)
    count(i, 1);
  const auto rank = [&](std::size_t i) {
    const bool is_person = detections[i].class_id == kPersonClass;
    const float z = regions[i].empty() ? std::numeric_limits<float>::max() : regions[i].median_m;
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

}  // namespace

std::vector<DepthRegion> SegmentDetections(const DepthView& view,
                                           const std::vector<Detection>& detections,
                                           const RegionOptions& options) {
  std::vector<DepthRegion> regions;
  regions.reserve(detections.size());
  for (const Detection& detection : detections)
    regions.push_back(Segment(view, detection, {}, options));
  cv::Mat taken;
  for (const std::size_t i : FrontToBack(detections, regions)) {
    const Detection& detection = detections[i];
    bool overlaps = false;
    for (const Detection& other : detections)
      overlaps = overlaps || (&other != &detection && Iou(other.box, detection.box) > 0.0);
    if (overlaps && !taken.empty()) regions[i] = Segment(view, detection, taken, options);
    if (regions[i].empty()) continue;
    if (taken.empty()) taken = cv::Mat::zeros(regions[i].mask.size(), CV_8UC1);
    taken.setTo(255, regions[i].mask);
  }
  return regions;
}

}  // namespace cslam
