// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/depth_region.h"

#include "cslam/objects/box_background.h"
#include "cslam/objects/box_occluders.h"
#include "cslam/util/options.h"
#include "cslam/util/quantile.h"
#include "cslam/vision/depth_thumbnail.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace cslam {
namespace {

constexpr double kBinM = 0.05;  // of the histogram that finds a box's main depth
constexpr double kFarthestM = 10.0;
constexpr float kMinStepM = 0.03F;  // noise of near readings
constexpr int kMinPixels = 12;      // fewer thumbnail pixels are no region

double BandOf(bool is_person, const RegionOptions& o) {
  return is_person ? o.person_band_m : o.movable_band_m;
}
double ReachOf(bool is_person, const RegionOptions& o) {
  return is_person ? o.person_reach_m : o.movable_reach_m;
}

cv::Rect ThumbnailRect(const DepthView& view, const Box& box, double margin) {
  const double step = view.step;
  const double mx = margin * box.width();
  const double my = margin * box.height();
  const int x0 = static_cast<int>(std::floor((box.x_min - mx) / step));
  const int y0 = static_cast<int>(std::floor((box.y_min - my) / step));
  const int x1 = static_cast<int>(std::ceil((box.x_max + mx) / step));
  const int y1 = static_cast<int>(std::ceil((box.y_max + my) / step));
  return cv::Rect(x0, y0, x1 - x0, y1 - y0) &
         cv::Rect(0, 0, view.depth_mm.cols, view.depth_mm.rows);
}

// The depth at which most of the box's middle lies; pixels near the centre count more, and of two
// depths that hold nearly as much the nearer one wins. 0 if there is no reading.
double MainDepth(const DepthView& view, const cv::Rect& rect, const cv::Mat& excluded,
                 double band_m) {
  constexpr double kNearlyAsMuch = 0.6;
  std::vector<double> bins(static_cast<std::size_t>(kFarthestM / kBinM) + 1, 0.0);
  for (int v = rect.y; v < rect.y + rect.height; ++v) {
    const double dy = 2.0 * (v + 0.5 - rect.y) / rect.height - 1.0;
    for (int u = rect.x; u < rect.x + rect.width; ++u) {
      const double z = static_cast<double>(view.DepthM(u, v));
      if (z <= 0.0 || z >= kFarthestM) continue;
      if (!excluded.empty() && excluded.at<std::uint8_t>(v, u) != 0) continue;
      const double dx = 2.0 * (u + 0.5 - rect.x) / rect.width - 1.0;
      const double weight = std::max(0.0, 1.0 - dx * dx) * std::max(0.1, 1.0 - dy * dy);
      bins[static_cast<std::size_t>(z / kBinM)] += weight;
    }
  }
  const auto window = std::max<std::size_t>(1, static_cast<std::size_t>(band_m / kBinM));
  std::vector<double> mass(bins.size(), 0.0);
  double sum = 0.0;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    sum += bins[i];
    if (i >= window) sum -= bins[i - window];
    mass[i] = sum;  // of the window that ends here
  }
  const double most = *std::max_element(mass.begin(), mass.end());
  if (most <= 0.0) return 0.0;
  std::size_t best = 0;
  while (mass[best] < kNearlyAsMuch * most)
    ++best;
  while (best + 1 < mass.size() && mass[best + 1] >= mass[best])
    ++best;
  return (static_cast<double>(best) + 1.0 - 0.5 * static_cast<double>(window)) * kBinM;
}

// Fills the summary of a mask.
DepthRegion Summarise(const DepthView& view, cv::Mat mask) {
  DepthRegion region;
  std::vector<float> z, x, y;
  int u_min = mask.cols, v_min = mask.rows, u_max = -1, v_max = -1;
  for (int v = 0; v < mask.rows; ++v) {
    const auto* row = mask.ptr<std::uint8_t>(v);
    for (int u = 0; u < mask.cols; ++u) {
      if (row[u] == 0) continue;
      ++region.num_pixels;
      u_min = std::min(u_min, u);
      u_max = std::max(u_max, u);
      v_min = std::min(v_min, v);
      v_max = std::max(v_max, v);
      const float depth = view.DepthM(u, v);
      if (depth <= 0.0F) continue;
      const Eigen::Vector3d p = view.PointAt(u, v, static_cast<double>(depth));
      x.push_back(static_cast<float>(p.x()));
      y.push_back(static_cast<float>(p.y()));
      z.push_back(depth);
    }
  }
  if (region.num_pixels < kMinPixels || z.empty()) return {};
  region.mask = std::move(mask);
  const double step = view.step;
  region.box = {u_min * step, v_min * step, (u_max + 1) * step, (v_max + 1) * step};
  region.median_m = MedianOf(std::move(z));
  region.centre_camera = {static_cast<double>(MedianOf(std::move(x))),
                          static_cast<double>(MedianOf(std::move(y))),
                          static_cast<double>(region.median_m)};
  return region;
}

}  // namespace

Eigen::Vector3d DepthView::PointAt(int u, int v, double depth_m) const {
  const double pixel_u = u * step + step / 2;
  const double pixel_v = v * step + step / 2;
  return {(pixel_u - camera.cx) / camera.fx * depth_m, (pixel_v - camera.cy) / camera.fy * depth_m,
          depth_m};
}

DepthViewMaker::DepthViewMaker(const Camera& camera)
    : camera_(camera),
      step_(DepthThumbnailStep(camera.width)),
      sources_(camera.height / step_, camera.width / step_, CV_32SC2) {
  for (int v = 0; v < sources_.rows; ++v) {
    for (int u = 0; u < sources_.cols; ++u) {
      const Eigen::Vector2d middle(u * step_ + step_ / 2, v * step_ + step_ / 2);
      const Eigen::Vector2d raw = Distort(camera, middle);
      const int source_u = static_cast<int>(std::lround(raw.x()));
      const int source_v = static_cast<int>(std::lround(raw.y()));
      const bool is_inside =
          source_u >= 0 && source_v >= 0 && source_u < camera.width && source_v < camera.height;
      sources_.at<cv::Vec2i>(v, u) = is_inside ? cv::Vec2i(source_u, source_v) : cv::Vec2i(-1, -1);
    }
  }
}

DepthView DepthViewMaker::Make(const cv::Mat& depth_m) const {
  DepthView view;
  view.step = step_;
  view.camera = camera_;
  if (depth_m.empty()) return view;
  constexpr float kMaxMm = 65535.0F;
  view.depth_mm = cv::Mat::zeros(sources_.size(), CV_16UC1);
  for (int v = 0; v < sources_.rows; ++v) {
    auto* row = view.depth_mm.ptr<std::uint16_t>(v);
    for (int u = 0; u < sources_.cols; ++u) {
      const cv::Vec2i& source = sources_.at<cv::Vec2i>(v, u);
      if (source[0] < 0) continue;
      const float mm = 1000.0F * depth_m.at<float>(source[1], source[0]);
      if (mm > 0.0F && mm < kMaxMm) row[u] = static_cast<std::uint16_t>(std::lround(mm));
    }
  }
  return view;
}

namespace {

// The box around the images of a box's corners and edge centres.
template <typename Transform>
Box AroundImage(const Box& box, const Transform& transform) {
  if (box.empty()) return box;
  const double inf = std::numeric_limits<double>::infinity();
  Box around{inf, inf, -inf, -inf};
  for (const double x : {box.x_min, 0.5 * (box.x_min + box.x_max), box.x_max}) {
    for (const double y : {box.y_min, 0.5 * (box.y_min + box.y_max), box.y_max}) {
      const Eigen::Vector2d p = transform(Eigen::Vector2d(x, y));
      around = {std::min(around.x_min, p.x()), std::min(around.y_min, p.y()),
                std::max(around.x_max, p.x()), std::max(around.y_max, p.y())};
    }
  }
  return around;
}

}  // namespace

Box DepthViewMaker::Undistorted(const Box& raw) const {
  if (!camera_.HasDistortion()) return raw;
  return AroundImage(raw, [&](const Eigen::Vector2d& p) { return Undistort(camera_, p); });
}

Box DepthViewMaker::Distorted(const Box& undistorted) const {
  if (!camera_.HasDistortion()) return undistorted;
  return AroundImage(undistorted, [&](const Eigen::Vector2d& p) { return Distort(camera_, p); });
}

void Describe(OptionList& list, RegionOptions& o) {
  list.Add("person_band", o.person_band_m, {0.05, 2.0}, "m",
           "Depth range around a box's main depth that is taken for the person's surface.");
  list.Add("movable_band", o.movable_band_m, {0.02, 2.0}, "m",
           "The same for things other than people.");
  list.Add("person_reach", o.person_reach_m, {0.1, 3.0}, "m",
           "How far in depth a person may reach from the middle of the surface.");
  list.Add("movable_reach", o.movable_reach_m, {0.05, 3.0}, "m",
           "The same for things other than people.");
  list.Add("step_ratio", o.step_ratio, {0.002, 0.5}, "",
           "Depth step between neighbours, as share of the depth, that parts two surfaces.");
  list.Add("box_margin", o.box_margin, {0.0, 1.0}, "",
           "How far a region may leave its box, as share of the box's size.");
  list.Add("carry_tolerance", o.carry_tolerance_m, {0.01, 1.0}, "m",
           "How far the depth may be off where a region is carried to.");
  list.Add("carry_speed", o.carry_speed_mps, {0.0, 20.0}, "m/s",
           "How fast a person's or mover's limbs may leave the region that is carried on.");
  list.Add("min_support", o.min_support, {0.0, 1.0}, "",
           "Share of a carried region whose depth must agree for it to be kept.");
  list.Group("background", o.background);
  list.Group("occluder", o.occluder);
}

DepthRegion GrowRegion(const DepthView& view, const cv::Mat& seeds, const cv::Mat& allowed,
                       double reach_m, double step_ratio) {
  std::vector<float> depths;
  for (int v = 0; v < seeds.rows; ++v) {
    for (int u = 0; u < seeds.cols; ++u) {
      if (seeds.at<std::uint8_t>(v, u) != 0 && view.DepthM(u, v) > 0.0F) {
        depths.push_back(view.DepthM(u, v));
      }
    }
  }
  if (static_cast<int>(depths.size()) < kMinPixels) return {};
  const float middle = MedianOf(std::move(depths));
  const auto reach = static_cast<float>(reach_m);
  const auto ratio = static_cast<float>(step_ratio);

  cv::Mat mask = cv::Mat::zeros(view.depth_mm.size(), CV_8UC1);
  std::vector<cv::Point> open;
  for (int v = 0; v < seeds.rows; ++v) {
    for (int u = 0; u < seeds.cols; ++u) {
      if (seeds.at<std::uint8_t>(v, u) == 0 || view.DepthM(u, v) <= 0.0F) continue;
      mask.at<std::uint8_t>(v, u) = 255;
      open.emplace_back(u, v);
    }
  }
  constexpr std::array<std::array<int, 2>, 4> kNeighbours{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  while (!open.empty()) {
    const cv::Point p = open.back();
    open.pop_back();
    const float z = view.DepthM(p.x, p.y);
    for (const auto& [du, dv] : kNeighbours) {
      const int u = p.x + du;
      const int v = p.y + dv;
      if (u < 0 || v < 0 || u >= mask.cols || v >= mask.rows) continue;
      if (mask.at<std::uint8_t>(v, u) != 0) continue;
      if (!allowed.empty() && allowed.at<std::uint8_t>(v, u) == 0) continue;
      const float neighbour = view.DepthM(u, v);
      if (neighbour <= 0.0F || std::abs(neighbour - middle) > reach) continue;
      if (std::abs(neighbour - z) > std::max(kMinStepM, ratio * z)) continue;
      mask.at<std::uint8_t>(v, u) = 255;
      open.emplace_back(u, v);
    }
  }
  // Pixels without a reading inside the surface belong to it.
  cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, cv::Mat::ones(3, 3, CV_8UC1));
  return Summarise(view, mask);
}

namespace {

// Pixels of rect with a reading within reach_m of the depth, where not excluded.
cv::Mat PixelsAround(const DepthView& view, const cv::Rect& rect, double depth_m, double reach_m,
                     const cv::Mat& excluded) {
  cv::Mat pixels = cv::Mat::zeros(view.depth_mm.size(), CV_8UC1);
  for (int v = rect.y; v < rect.y + rect.height; ++v) {
    for (int u = rect.x; u < rect.x + rect.width; ++u) {
      const double z = static_cast<double>(view.DepthM(u, v));
      if (z <= 0.0 || std::abs(z - depth_m) > reach_m) continue;
      if (!excluded.empty() && excluded.at<std::uint8_t>(v, u) != 0) continue;
      pixels.at<std::uint8_t>(v, u) = 255;
    }
  }
  return pixels;
}

// Masks of one size, or empty.
cv::Mat Either(const cv::Mat& a, const cv::Mat& b) {
  if (a.empty()) return b;
  return b.empty() ? a : cv::Mat(a | b);
}

// A thing is about as deep as it is large: how far it may reach from its main depth.
double ReachOfBox(const DepthView& view, const Box& box, double main_m, bool is_person,
                  const RegionOptions& options) {
  constexpr double kDepthOfSize = 0.9;
  const double reach_m = ReachOf(is_person, options);
  if (is_person) return reach_m;
  const double size_m = std::max(box.width(), box.height()) * main_m / view.camera.fx;
  return std::min(reach_m, std::max(0.5 * options.movable_band_m, kDepthOfSize * size_m));
}

}  // namespace

DepthRegion SegmentBox(const DepthView& view, const Box& box, bool is_person, const cv::Mat& taken,
                       const RegionOptions& options) {
  if (view.empty() || box.empty()) return {};
  const cv::Rect rect = ThumbnailRect(view, box, 0.0);
  if (rect.empty()) return {};
  BoxBackground around;
  cv::Mat excluded = taken;
  if (!is_person) {
    around = FindBoxBackground(view, rect, taken, options.background);
    excluded = Either(taken, Either(around.mask, FindBoxOccluders(view, rect, options.step_ratio,
                                                                  options.occluder)));
  }
  const double band = BandOf(is_person, options);
  const double main_m = MainDepth(view, rect, excluded, band);
  if (main_m <= 0.0) return {};
  const double reach_m = ReachOfBox(view, box, main_m, is_person, options);
  DepthRegion region;
  if (!around.mask.empty()) {
    // Without floor and wall all that is left is the thing, in one piece or not: its back shows
    // on both sides of what sits on it.
    cv::Mat mask = PixelsAround(view, rect, main_m, reach_m, excluded);
    cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, cv::Mat::ones(3, 3, CV_8UC1));
    region = Summarise(view, mask);
  } else {
    const cv::Mat seeds = PixelsAround(view, rect, main_m, 0.5 * band, excluded);
    cv::Mat allowed = cv::Mat::zeros(view.depth_mm.size(), CV_8UC1);
    allowed(ThumbnailRect(view, box, options.box_margin)).setTo(255);
    if (!excluded.empty()) allowed.setTo(0, excluded);
    region = GrowRegion(view, seeds, allowed, reach_m, options.step_ratio);
  }
  region.is_flat = around.is_flat;
  region.is_on_wall = around.is_on_wall;
  region.support = region.empty() ? 0.0 : 1.0;
  return region;
}

DepthRegion SegmentMask(const DepthView& view, const Box& box, const cv::Mat& mask, bool is_person,
                        const cv::Mat& excluded, const RegionOptions& options) {
  if (view.empty() || box.empty() || mask.empty()) return {};
  const cv::Rect rect = ThumbnailRect(view, box, 0.0);
  if (rect.empty()) return {};
  cv::Mat allowed = cv::Mat::zeros(view.depth_mm.size(), CV_8UC1);
  for (int v = rect.y; v < rect.y + rect.height; ++v) {
    for (int u = rect.x; u < rect.x + rect.width; ++u) {
      const double x = ((u + 0.5) * view.step - box.x_min) / box.width();
      const double y = ((v + 0.5) * view.step - box.y_min) / box.height();
      const int column = std::clamp(static_cast<int>(x * mask.cols), 0, mask.cols - 1);
      const int row = std::clamp(static_cast<int>(y * mask.rows), 0, mask.rows - 1);
      if (mask.at<std::uint8_t>(row, column) != 0) allowed.at<std::uint8_t>(v, u) = 255;
    }
  }
  if (!excluded.empty()) allowed.setTo(0, excluded);
  DepthRegion region =
      GrowRegion(view, allowed, allowed, ReachOf(is_person, options), options.step_ratio);
  region.support = region.empty() ? 0.0 : 1.0;
  return region;
}

DepthRegion CarryRegion(const DepthView& from, const DepthRegion& region, const DepthView& to,
                        const Se3& T_to_from, const Eigen::Vector3d& shift_m, double margin_px,
                        bool is_person, const RegionOptions& options) {
  if (region.empty() || from.empty() || to.empty()) return {};
  cv::Mat expected = cv::Mat::zeros(to.depth_mm.size(), CV_32FC1);  // m; 0: not covered
  const Eigen::Matrix3d R = T_to_from.R();
  const Eigen::Vector3d t = T_to_from.translation + shift_m;
  for (int v = 0; v < region.mask.rows; ++v) {
    for (int u = 0; u < region.mask.cols; ++u) {
      if (region.mask.at<std::uint8_t>(v, u) == 0) continue;
      const float depth = from.DepthM(u, v);
      const double z =
          depth > 0.0F ? static_cast<double>(depth) : static_cast<double>(region.median_m);
      const Eigen::Vector3d p = R * from.PointAt(u, v, z) + t;
      if (p.z() <= 0.05) continue;
      const Eigen::Vector2d uv(to.camera.fx * p.x() / p.z() + to.camera.cx,
                               to.camera.fy * p.y() / p.z() + to.camera.cy);
      const int tu = static_cast<int>(std::floor(uv.x() / to.step));
      const int tv = static_cast<int>(std::floor(uv.y() / to.step));
      if (tu < 0 || tv < 0 || tu >= expected.cols || tv >= expected.rows) continue;
      float& cell = expected.at<float>(tv, tu);
      const auto seen = static_cast<float>(p.z());
      if (cell == 0.0F || seen < cell) cell = seen;
    }
  }
  cv::Mat covered = expected > 0.0F;
  int num_expected = 0;
  int num_agreeing = 0;
  cv::Mat seeds = cv::Mat::zeros(covered.size(), CV_8UC1);
  const auto tolerance = static_cast<float>(options.carry_tolerance_m);
  for (int v = 0; v < seeds.rows; ++v) {
    for (int u = 0; u < seeds.cols; ++u) {
      const float wanted = expected.at<float>(v, u);
      const float depth = to.DepthM(u, v);
      if (wanted == 0.0F || depth == 0.0F) continue;
      ++num_expected;
      if (std::abs(depth - wanted) > tolerance) continue;
      ++num_agreeing;
      seeds.at<std::uint8_t>(v, u) = 255;
    }
  }
  if (num_agreeing < kMinPixels) return {};
  const double support = static_cast<double>(num_agreeing) / num_expected;
  if (support < options.min_support) return {};
  const int margin = static_cast<int>(std::ceil(margin_px / to.step));
  cv::Mat allowed;
  cv::dilate(covered, allowed, cv::Mat::ones(2 * margin + 1, 2 * margin + 1, CV_8UC1));
  DepthRegion carried =
      GrowRegion(to, seeds, allowed, ReachOf(is_person, options), options.step_ratio);
  carried.support = support;
  return carried;
}

}  // namespace cslam
