// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/geometry/se3.h"
#include "cslam/objects/depth_region.h"

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cslam {

class OptionList;

// How a place that is known is compared with what depth shows there. "Unobserved" is not "absent":
// only what could be seen and is not there speaks against it.
struct ExpectedViewOptions {
  double tolerance_m = 0.02;        // of depth against a stored surface, at 0 m ...
  double tolerance_per_m2 = 0.005;  // ... and its growth with the depth squared
  double max_depth_m = 4.5;         // farther readings say nothing
  double min_visible_share = 0.4;   // of the samples, before anything is concluded
  double min_through_share = 0.6;   // of the visible ones: one looks through its place
  double min_rim_share = 0.1;       // ... or only so many, if one looks through all of them
  double min_taken_through = 0.25;  // the same, where another thing stands on the rest
  double min_standing_share = 0.5;  // of the visible ones: its surface stands there

  double ToleranceM(double depth_m) const {
    return tolerance_m + tolerance_per_m2 * depth_m * depth_m;
  }
};
void Describe(OptionList& list, ExpectedViewOptions& options);

// A reduced depth image, and how points get into it.
struct DepthSampler {
  const cv::Mat* depth_mm = nullptr;  // CV_16UC1, 0 = none
  int step = 4;                       // full-size pixels per pixel of depth_mm
  const Camera* camera = nullptr;
  bool is_distorted = false;  // as recorded (keyframes keep it so), not undistorted
  // Pixels of things of other kinds (CV_8UC1 of the same size, or null): what stands there is not
  // what is looked for.
  const cv::Mat* others = nullptr;
};

// Of a keyframe's depth thumbnail: as recorded.
DepthSampler ThumbnailSampler(const cv::Mat& depth_small_mm, const Camera& camera);

// What a depth image shows where a point is expected.
enum class PointVerdict : std::uint8_t {
  kOutside,  // of the picture, or too far
  kUnclear,  // beside an edge, or no depth
  kHidden,   // behind something nearer
  kTaken,    // another thing stands there
  kStanding,
  kThrough,
};
PointVerdict LookAtPoint(const Eigen::Vector3d& p_camera, const DepthSampler& depth,
                         double pose_sigma_m, const ExpectedViewOptions& options);

enum class PlaceVerdict : std::uint8_t {
  kUnobserved,     // out of view, hidden, too far, without depth, or neither clearly
  kStanding,       // a surface is where it is expected
  kTaken,          // ... but for the most part it is that of another thing
  kLookedThrough,  // one sees what is behind it
};

// What became of the samples of a surface.
struct ExpectedView {
  int num_samples = 0;
  int num_standing = 0;
  int num_through = 0;
  int num_taken = 0;    // another thing stands there
  int num_hidden = 0;   // behind something nearer
  int num_unclear = 0;  // beside an edge, or no depth
  int num_outside = 0;  // of the picture, or too far
  PlaceVerdict verdict = PlaceVerdict::kUnobserved;

  int num_visible() const { return num_standing + num_through + num_taken; }
  double through_share() const {
    return num_visible() == 0 ? 0.0 : static_cast<double>(num_through) / num_visible();
  }
};

// samples: in the frame that T_camera_samples takes to the camera's. pose_sigma_m widens the test.
ExpectedView LookAtPlace(std::span<const Eigen::Vector3f> samples, const Se3& T_camera_samples,
                         const DepthSampler& depth, double pose_sigma_m,
                         const ExpectedViewOptions& options);

// The pixel that the point (camera frame, m) falls on, if what is seen there is as far away.
std::optional<cv::Point> PixelOfSurface(const DepthView& view, const Eigen::Vector3d& p_camera,
                                        double tolerance_m);

// Of a surface, what is in this picture and stands where it is expected.
struct StandingSurface {
  int num_samples = 0;
  int num_standing = 0;
  int num_covered = 0;  // of these, by a region

  double covered_share() const {
    return num_standing == 0 ? 0.0 : static_cast<double>(num_covered) / num_standing;
  }
};

// The pixels at which samples stand where they are expected.
std::vector<cv::Point> PixelsOfStanding(std::span<const Eigen::Vector3f> samples,
                                        const Se3& T_camera_samples, const DepthView& view,
                                        const ExpectedViewOptions& options);

// region: CV_8UC1 of the view's size, non-zero inside. standing: of num_samples.
StandingSurface CoveredBy(const cv::Mat& region, std::span<const cv::Point> standing,
                          std::size_t num_samples);

// Both together.
StandingSurface FindStanding(std::span<const Eigen::Vector3f> samples, const Se3& T_camera_samples,
                             const DepthView& view, const cv::Mat& region,
                             const ExpectedViewOptions& options);

}  // namespace cslam
