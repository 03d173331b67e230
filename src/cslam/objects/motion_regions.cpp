// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/motion_regions.h"

#include "cslam/util/options.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace cslam {
namespace {

// Marks the pixels of now whose surface stands in what `earlier` saw as free space. An opened gap
// of one pixel on each side keeps edges out: of the nine readings around, the nearest counts.
void MarkSeenThrough(const DepthView& now, const EarlierView& earlier,
                     const MotionRegionOptions& options, cv::Mat moved) {
  const DepthView& before = *earlier.view;
  cv::Mat nearest;
  cv::erode(before.depth_mm, nearest, cv::Mat::ones(3, 3, CV_8UC1));
  const Eigen::Matrix3d R = earlier.T_earlier_now.R();
  const Eigen::Vector3d& t = earlier.T_earlier_now.translation;
  for (int v = 0; v < now.depth_mm.rows; ++v) {
    auto* row = moved.ptr<std::uint8_t>(v);
    for (int u = 0; u < now.depth_mm.cols; ++u) {
      const float depth = now.DepthM(u, v);
      if (depth <= 0.0F) continue;
      const Eigen::Vector3d p = R * now.PointAt(u, v, static_cast<double>(depth)) + t;
      if (p.z() <= 0.1) continue;
      const int bu = static_cast<int>(
          std::floor((before.camera.fx * p.x() / p.z() + before.camera.cx) / before.step));
      const int bv = static_cast<int>(
          std::floor((before.camera.fy * p.y() / p.z() + before.camera.cy) / before.step));
      if (bu < 1 || bv < 1 || bu + 1 >= nearest.cols || bv + 1 >= nearest.rows) continue;
      const double free_m = 0.001 * nearest.at<std::uint16_t>(bv, bu);
      const double margin = options.margin_m + options.margin_per_m2 * p.z() * p.z();
      if (free_m > p.z() + margin) row[u] = 255;
    }
  }
}

}  // namespace

void Describe(OptionList& list, MotionRegionOptions& o) {
  list.Add("enabled", o.enabled, "Find things that move though no detector knows them.");
  list.Add("reference_age", o.reference_age_s, {0.03, 5.0}, "s",
           "Age of the view that the present one is compared with.");
  list.Add("margin", o.margin_m, {0.0, 2.0}, "m",
           "Free space must have been seen this far behind a surface for it to have moved.");
  list.Add("margin_growth", o.margin_per_m2, {0.0, 1.0}, "m/m^2",
           "Growth of that margin with the square of the depth.");
  list.Add("min_area", o.min_area_share, {0.0, 1.0}, "",
           "Smaller shares of the picture are noise.");
  list.Add("max_area", o.max_area_share, {0.0, 1.0}, "",
           "Larger shares of the picture speak of a wrong pose.");
  list.Add("reach", o.reach_m, {0.05, 3.0}, "m", "Extent in depth of a thing that moves.");
  list.Add("growth", o.growth_px, {0.0, 640.0}, "px",
           "How far a region may grow from what was seen to move.");
  list.Add("min_inliers", o.min_inliers, {0, 10'000}, "matches",
           "A pose with fewer inliers is too uncertain to judge motion by.");
}

std::vector<DepthRegion> FindMovedRegions(const DepthView& now,
                                          std::span<const EarlierView> earlier,
                                          const cv::Mat& known,
                                          const MotionRegionOptions& options) {
  if (now.empty() || earlier.empty()) return {};
  cv::Mat moved = cv::Mat::zeros(now.depth_mm.size(), CV_8UC1);
  for (const EarlierView& view : earlier) {
    if (view.view->depth_mm.size() == now.depth_mm.size()) {
      MarkSeenThrough(now, view, options, moved);
    }
  }
  const auto total = static_cast<double>(moved.total());
  if (cv::countNonZero(moved) > options.max_area_share * total) return {};
  if (!known.empty()) moved.setTo(0, known);
  cv::morphologyEx(moved, moved, cv::MORPH_OPEN, cv::Mat::ones(3, 3, CV_8UC1));

  cv::Mat labels;
  cv::Mat statistics;
  cv::Mat centroids;
  const int count = cv::connectedComponentsWithStats(moved, labels, statistics, centroids, 4);
  const int reach = 2 * static_cast<int>(options.growth_px / now.step) + 1;
  cv::Mat covered = known.empty() ? cv::Mat::zeros(moved.size(), CV_8UC1) : known.clone();
  std::vector<DepthRegion> regions;
  for (int label = 1; label < count; ++label) {
    if (statistics.at<int>(label, cv::CC_STAT_AREA) < options.min_area_share * total) continue;
    cv::Mat seeds = labels == label;
    seeds.setTo(0, covered);
    cv::Mat allowed;
    cv::dilate(seeds, allowed, cv::Mat::ones(reach, reach, CV_8UC1));
    allowed.setTo(0, covered);
    constexpr double kStepRatio = 0.03;
    DepthRegion region = GrowRegion(now, seeds, allowed, options.reach_m, kStepRatio);
    if (region.empty()) continue;
    covered.setTo(255, region.mask);
    regions.push_back(std::move(region));
  }
  return regions;
}

}  // namespace cslam
