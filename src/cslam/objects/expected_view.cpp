// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/expected_view.h"

#include "cslam/util/options.h"
#include "cslam/vision/depth_thumbnail.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cslam {
namespace {

constexpr int kBorderPx = 1;  // of depth_mm: the neighbourhood must lie inside

// Of the readings around a pixel.
double NearestAroundM(const cv::Mat& depth_mm, int u, int v) {
  double nearest_m = std::numeric_limits<double>::max();
  for (int dv = -kBorderPx; dv <= kBorderPx; ++dv) {
    for (int du = -kBorderPx; du <= kBorderPx; ++du) {
      const double z = 0.001 * depth_mm.at<std::uint16_t>(v + dv, u + du);
      if (z > 0.0) nearest_m = std::min(nearest_m, z);
    }
  }
  return nearest_m;
}

// Most of the place is hidden, like that of a chair behind an umbrella, but where the rest of it
// should stick out one looks through without exception.
bool IsRimLookedThrough(const ExpectedView& view, const ExpectedViewOptions& options) {
  constexpr int kMinSamples = 8;
  constexpr double kMinShare = 0.8;
  return view.num_through >= kMinSamples &&
         view.num_through >= options.min_rim_share * view.num_samples && view.num_standing == 0 &&
         view.num_through >= kMinShare * view.num_visible() &&
         view.num_hidden >= 0.5 * view.num_samples;
}

PlaceVerdict Judge(const ExpectedView& view, const ExpectedViewOptions& options) {
  const double visible = view.num_visible();
  if (IsRimLookedThrough(view, options)) return PlaceVerdict::kLookedThrough;
  if (visible <= 0.0 || visible < options.min_visible_share * view.num_samples) {
    return PlaceVerdict::kUnobserved;
  }
  if (view.num_through >= options.min_through_share * visible) return PlaceVerdict::kLookedThrough;
  if (view.num_through >= options.min_taken_through * visible &&
      view.num_through + view.num_taken >= options.min_through_share * visible) {
    return PlaceVerdict::kLookedThrough;
  }
  const double min_standing = options.min_standing_share * visible;
  if (view.num_standing >= min_standing) return PlaceVerdict::kStanding;
  if (view.num_standing + view.num_taken >= min_standing) return PlaceVerdict::kTaken;
  return PlaceVerdict::kUnobserved;
}

}  // namespace

void Describe(OptionList& list, ExpectedViewOptions& o) {
  list.Add("tolerance", o.tolerance_m, {0.0, 1.0}, "m",
           "How far depth may lie from a stored surface: registration errors.");
  list.Add("tolerance_per_m2", o.tolerance_per_m2, {0.0, 0.2}, "1/m",
           "Growth of that with the depth squared: noise of stereo cameras.");
  list.Add("max_depth", o.max_depth_m, {0.5, 20.0}, "m", "Beyond, depth says nothing.");
  list.Add("min_visible", o.min_visible_share, {0.0, 1.0}, "",
           "Share of a surface that must be in view, with depth and not hidden.");
  list.Add("min_rim", o.min_rim_share, {0.0, 1.0}, "",
           "Share that suffices where something hides the rest, if all of it is looked through.");
  list.Add("min_through", o.min_through_share, {0.0, 1.0}, "",
           "Share of that which must be looked through for the place to be empty; some of what "
           "is stored may be floor or wall.");
  list.Add("min_taken_through", o.min_taken_through, {0.0, 1.0}, "",
           "... if another thing stands on the rest of it: it was replaced.");
  list.Add("min_standing", o.min_standing_share, {0.0, 1.0}, "",
           "Share of that which must be there for the place to be taken.");
}

DepthSampler ThumbnailSampler(const cv::Mat& depth_small_mm, const Camera& camera) {
  return {&depth_small_mm, DepthThumbnailStep(camera.width), &camera, camera.HasDistortion()};
}

PointVerdict LookAtPoint(const Eigen::Vector3d& p, const DepthSampler& depth, double pose_sigma_m,
                         const ExpectedViewOptions& options) {
  const cv::Mat& image = *depth.depth_mm;
  if (p.z() < 0.1 || p.z() > options.max_depth_m || image.empty()) return PointVerdict::kOutside;
  Eigen::Vector2d uv = Project(*depth.camera, p);
  if (depth.is_distorted) uv = Distort(*depth.camera, uv);
  const int u = static_cast<int>(std::floor(uv.x() / depth.step));
  const int v = static_cast<int>(std::floor(uv.y() / depth.step));
  if (!(u >= kBorderPx && v >= kBorderPx && u < image.cols - kBorderPx &&
        v < image.rows - kBorderPx)) {
    return PointVerdict::kOutside;
  }
  const double here_m = 0.001 * image.at<std::uint16_t>(v, u);
  const double tolerance = options.ToleranceM(p.z()) + pose_sigma_m;
  if (here_m <= 0.0) return PointVerdict::kUnclear;
  if (here_m < p.z() - tolerance) return PointVerdict::kHidden;
  if (here_m <= p.z() + tolerance) {
    const bool is_taken = depth.others != nullptr && !depth.others->empty() &&
                          depth.others->at<std::uint8_t>(v, u) != 0;
    return is_taken ? PointVerdict::kTaken : PointVerdict::kStanding;
  }
  return NearestAroundM(image, u, v) > p.z() + tolerance ? PointVerdict::kThrough
                                                         : PointVerdict::kUnclear;
}

ExpectedView LookAtPlace(std::span<const Eigen::Vector3f> samples, const Se3& T_camera_samples,
                         const DepthSampler& depth, double pose_sigma_m,
                         const ExpectedViewOptions& options) {
  ExpectedView view;
  view.num_samples = static_cast<int>(samples.size());
  for (const Eigen::Vector3f& sample : samples) {
    const Eigen::Vector3d p = T_camera_samples * sample.cast<double>();
    switch (LookAtPoint(p, depth, pose_sigma_m, options)) {
      case PointVerdict::kOutside:
        ++view.num_outside;
        break;
      case PointVerdict::kUnclear:
        ++view.num_unclear;
        break;
      case PointVerdict::kHidden:
        ++view.num_hidden;
        break;
      case PointVerdict::kTaken:
        ++view.num_taken;
        break;
      case PointVerdict::kStanding:
        ++view.num_standing;
        break;
      case PointVerdict::kThrough:
        ++view.num_through;
        break;
    }
  }
  view.verdict = Judge(view, options);
  return view;
}

std::optional<cv::Point> PixelOfSurface(const DepthView& view, const Eigen::Vector3d& p_camera,
                                        double tolerance_m) {
  if (p_camera.z() < 0.1) return std::nullopt;
  const Eigen::Vector2d uv = Project(view.camera, p_camera);
  const int u = static_cast<int>(std::floor(uv.x() / view.step));
  const int v = static_cast<int>(std::floor(uv.y() / view.step));
  if (u < 0 || v < 0 || u >= view.depth_mm.cols || v >= view.depth_mm.rows) return std::nullopt;
  const double z_m = static_cast<double>(view.DepthM(u, v));
  if (z_m <= 0.0 || std::abs(z_m - p_camera.z()) > tolerance_m) return std::nullopt;
  return cv::Point(u, v);
}

std::vector<cv::Point> PixelsOfStanding(std::span<const Eigen::Vector3f> samples,
                                        const Se3& T_camera_samples, const DepthView& view,
                                        const ExpectedViewOptions& options) {
  std::vector<cv::Point> pixels;
  pixels.reserve(samples.size());
  for (const Eigen::Vector3f& sample : samples) {
    const Eigen::Vector3d p = T_camera_samples * sample.cast<double>();
    if (const auto pixel = PixelOfSurface(view, p, options.ToleranceM(p.z())))
      pixels.push_back(*pixel);
  }
  return pixels;
}

StandingSurface CoveredBy(const cv::Mat& region, std::span<const cv::Point> standing,
                          std::size_t num_samples) {
  StandingSurface surface;
  surface.num_samples = static_cast<int>(num_samples);
  surface.num_standing = static_cast<int>(standing.size());
  for (const cv::Point& pixel : standing)
    surface.num_covered += region.at<std::uint8_t>(pixel) != 0 ? 1 : 0;
  return surface;
}

StandingSurface FindStanding(std::span<const Eigen::Vector3f> samples, const Se3& T_camera_samples,
                             const DepthView& view, const cv::Mat& region,
                             const ExpectedViewOptions& options) {
  return CoveredBy(region, PixelsOfStanding(samples, T_camera_samples, view, options),
                   samples.size());
}

}  // namespace cslam
