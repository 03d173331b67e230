// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/motion_regions.h"

#include "cslam/util/options.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace cslam {
namespace {

enum class Seen { kNothing, kSame, kThrough };

// Thumbnail pixels by which edges may be misplaced: the faster the camera turns, the more.
int EdgeWidth(const DepthView& now, const EarlierView& earlier,
              const MotionRegionOptions& options) {
  constexpr int kMaxWidth = 5;
  if (earlier.age_s <= 0.0) return 1;
  const double turned_rad = Log(earlier.T_earlier_now).head<3>().norm();
  const double shift_px = turned_rad / earlier.age_s * options.timing_s * now.camera.fx;
  return std::min(kMaxWidth, 1 + static_cast<int>(shift_px / now.step));
}

// Compares the pixels of now with an earlier view. A gap on each side keeps edges out: of the
// readings around, the nearest counts as how far that view could see.
class Comparison {
 public:
  Comparison(const DepthView& now, const EarlierView& earlier, const MotionRegionOptions& options)
      : now_(now),
        before_(*earlier.view),
        R_(earlier.T_earlier_now.R()),
        t_(earlier.T_earlier_now.translation),
        options_(options) {
    const int width = 2 * EdgeWidth(now, earlier, options) + 1;
    const cv::Mat around = cv::Mat::ones(width, width, CV_8UC1);
    cv::erode(before_.depth_mm, nearest_, around);
    cv::dilate(before_.depth_mm, farthest_, around);
  }

  Seen At(int u, int v) const {
    const float depth = now_.DepthM(u, v);
    if (depth <= 0.0F) return Seen::kNothing;
    const Eigen::Vector3d p = R_ * now_.PointAt(u, v, static_cast<double>(depth)) + t_;
    if (p.z() <= 0.1) return Seen::kNothing;
    const int bu = static_cast<int>(
        std::floor((before_.camera.fx * p.x() / p.z() + before_.camera.cx) / before_.step));
    const int bv = static_cast<int>(
        std::floor((before_.camera.fy * p.y() / p.z() + before_.camera.cy) / before_.step));
    if (bu < 1 || bv < 1 || bu + 1 >= nearest_.cols || bv + 1 >= nearest_.rows) {
      return Seen::kNothing;
    }
    const double near_m = 0.001 * nearest_.at<std::uint16_t>(bv, bu);
    const double far_m = 0.001 * farthest_.at<std::uint16_t>(bv, bu);
    const double margin = options_.margin_m + options_.margin_per_m2 * p.z() * p.z();
    if (near_m > p.z() + margin) return Seen::kThrough;
    const bool is_same = near_m > 0.0 && near_m < p.z() + margin && far_m > p.z() - margin;
    return is_same ? Seen::kSame : Seen::kNothing;
  }

 private:
  const DepthView& now_;
  const DepthView& before_;
  Eigen::Matrix3d R_;
  Eigen::Vector3d t_;
  const MotionRegionOptions& options_;
  cv::Mat nearest_;
  cv::Mat farthest_;
};

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
  list.Add("timing", o.timing_s, {0.0, 0.2}, "s",
           "How far apart colour, depth and their rows may be taken: edges count the less, the "
           "faster the camera turns.");
  list.Add("max_turn_rate", o.max_turn_rate_dps, {0.0, 1000.0}, "deg/s",
           "Frames taken while the camera turns faster are neither judged nor compared with.");
  list.Add("min_inliers", o.min_inliers, {0, 10'000}, "matches",
           "A pose with fewer inliers is too uncertain to judge motion by.");
}

SurfaceMotion JudgeSurface(const DepthView& now, const DepthRegion& region,
                           const EarlierView& earlier, const MotionRegionOptions& options) {
  constexpr int kMinJudged = 30;  // thumbnail pixels
  constexpr double kMinJudgedShare = 0.4;
  constexpr double kRestingShare = 0.9;  // of the judged pixels that see the same surface
  constexpr double kMovingShare = 0.2;   // that stand in what was free space
  if (region.empty() || earlier.view->depth_mm.size() != now.depth_mm.size()) {
    return SurfaceMotion::kNotKnown;
  }
  const Comparison comparison(now, earlier, options);
  int same = 0;
  int through = 0;
  for (int v = 0; v < region.mask.rows; ++v) {
    for (int u = 0; u < region.mask.cols; ++u) {
      if (region.mask.at<std::uint8_t>(v, u) == 0) continue;
      const Seen seen = comparison.At(u, v);
      same += seen == Seen::kSame ? 1 : 0;
      through += seen == Seen::kThrough ? 1 : 0;
    }
  }
  const int judged = same + through;
  if (judged < kMinJudged || judged < kMinJudgedShare * region.num_pixels) {
    return SurfaceMotion::kNotKnown;
  }
  if (same >= kRestingShare * judged) return SurfaceMotion::kRests;
  return through >= kMovingShare * judged ? SurfaceMotion::kMoves : SurfaceMotion::kNotKnown;
}

std::vector<DepthRegion> FindMovedRegions(const DepthView& now,
                                          std::span<const EarlierView> earlier,
                                          const cv::Mat& known,
                                          const MotionRegionOptions& options) {
  if (now.empty() || earlier.empty()) return {};
  cv::Mat moved(now.depth_mm.size(), CV_8UC1, cv::Scalar(255));
  for (const EarlierView& view : earlier) {
    if (view.view->depth_mm.size() != now.depth_mm.size()) return {};
    const Comparison comparison(now, view, options);
    for (int v = 0; v < moved.rows; ++v) {
      auto* row = moved.ptr<std::uint8_t>(v);
      for (int u = 0; u < moved.cols; ++u) {
        if (row[u] != 0 && comparison.At(u, v) != Seen::kThrough) row[u] = 0;
      }
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
