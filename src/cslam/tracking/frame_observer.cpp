// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/tracking/frame_observer.h"

#include "cslam/util/stopwatch.h"
#include "cslam/vision/depth_thumbnail.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace cslam {
namespace {

template <typename T>
std::vector<T> Without(const std::vector<T>& values, const std::vector<std::uint8_t>& is_dropped) {
  std::vector<T> kept;
  kept.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (is_dropped[i] == 0) kept.push_back(values[i]);
  }
  return kept;
}

// Full-size mask of where keypoints may come from, given a thumbnail mask of where they may not.
cv::Mat AllowedMask(const cv::Mat& forbidden_small, const cv::Size& size, int border_px) {
  cv::Mat forbidden;
  cv::resize(forbidden_small, forbidden, size, 0.0, 0.0, cv::INTER_NEAREST);
  const int width = 2 * border_px + 1;
  cv::dilate(forbidden, forbidden, cv::Mat::ones(width, width, CV_8UC1));
  return forbidden == 0;
}

// A thumbnail mask of undistorted pixels, moved to the pixels as recorded. Their edges are
// uncertain by a pixel, so it is one wider.
cv::Mat RecordedMask(const cv::Mat& undistorted, const Camera& camera) {
  cv::Mat wider;
  cv::dilate(undistorted, wider, cv::Mat::ones(3, 3, CV_8UC1));
  if (!camera.HasDistortion()) return wider;
  const int step = DepthThumbnailStep(camera.width);
  cv::Mat recorded = cv::Mat::zeros(wider.size(), CV_8UC1);
  const cv::Rect inside(cv::Point(), wider.size());
  for (int v = 0; v < recorded.rows; ++v) {
    for (int u = 0; u < recorded.cols; ++u) {
      const Eigen::Vector2d raw_px(u * step + step / 2, v * step + step / 2);
      const Eigen::Vector2d uv = (Undistort(camera, raw_px) / step).array().floor();
      const cv::Point pixel(static_cast<int>(uv.x()), static_cast<int>(uv.y()));
      if (inside.contains(pixel)) recorded.at<std::uint8_t>(v, u) = wider.at<std::uint8_t>(pixel);
    }
  }
  return recorded;
}

void ReportKeypoints(TrackingResult& result, const FrameFeatures& features) {
  for (std::size_t i = 0; i < features.size(); ++i)
    result.keypoints.push_back({features.keypoints[i].raw_px, features.semantics[i].label});
}

}  // namespace

FrameFeatures WithoutKeypoints(const FrameFeatures& features,
                               const std::vector<std::uint8_t>& is_dropped,
                               const ImageBounds& bounds) {
  FrameFeatures kept;
  kept.keypoints = Without(features.keypoints, is_dropped);
  kept.descriptors = Without(features.descriptors, is_dropped);
  kept.semantics = Without(features.semantics, is_dropped);
  kept.grid = KeypointGrid(bounds, kept.keypoints);
  return kept;
}

FrameObserver::FrameObserver(const Camera& camera, const TrackerOptions& options)
    : camera_(camera),
      bounds_(UndistortedBounds(camera)),
      options_(options),
      extractor_(options.orb),
      objects_(camera, options.objects) {}

FrameFeatures FrameObserver::Measure(const RgbdFrame& frame, const cv::Mat& mask) {
  return MeasureFeatures(extractor_.Extract(frame.gray, mask), frame, camera_, bounds_,
                         options_.depth);
}

// Writes the labels into features; the result tells which keypoints are dynamic.
std::vector<std::uint8_t> FrameObserver::Label(FrameFeatures& features) const {
  features.semantics = objects_.Label(features.keypoints);
  std::vector<std::uint8_t> is_dynamic(features.size());
  std::transform(features.semantics.begin(), features.semantics.end(), is_dynamic.begin(),
                 [](const KeypointSemantics& s) -> std::uint8_t {
                   return s.label == KeypointLabel::kDynamic ? 1 : 0;
                 });
  return is_dynamic;
}

std::shared_ptr<KeyframeData> FrameObserver::Observe(
    const RgbdFrame& frame, const std::optional<PosePrediction>& prediction,
    const Detections* detections, TrackingResult& result) {
  Stopwatch watch;
  auto data = std::make_shared<KeyframeData>();
  data->frame = frame.id;
  data->stamp = frame.stamp;
  data->features = Measure(frame, {});
  AddLap(result.times, "extract", watch);
  result.num_keypoints = static_cast<int>(data->features.size());
  if (!options_.objects.enabled) return data;

  const PosePrediction pose = prediction.value_or(PosePrediction{});
  objects_.Observe(frame.id, frame.stamp, frame.depth_m, pose.T_world_camera, pose.T_world_last,
                   detections);
  std::vector<std::uint8_t> is_dynamic = Label(data->features);
  const auto num_dynamic = std::count(is_dynamic.begin(), is_dynamic.end(), std::uint8_t{1});
  result.num_dynamic_keypoints = static_cast<int>(num_dynamic);
  AddLap(result.times, "label", watch);
  if (options_.report_keypoints) ReportKeypoints(result, data->features);
  if (num_dynamic == 0) return data;

  const int num_static = result.num_keypoints - result.num_dynamic_keypoints;
  const cv::Mat mask = objects_.DynamicMask();
  if (num_static < options_.repopulate_below && !mask.empty()) {
    FrameFeatures more =
        Measure(frame, AllowedMask(mask, frame.gray.size(), options_.objects.labels.border_px));
    is_dynamic = Label(more);
    data->features = std::move(more);
    AddLap(result.times, "repopulate", watch);
  }
  data->features = WithoutKeypoints(data->features, is_dynamic, bounds_);
  return data;
}

std::vector<std::uint8_t> FrameObserver::FindUnknown(const Se3& T_world_camera, int num_inliers,
                                                     const KeyframeData& data) {
  if (!options_.objects.enabled) return {};
  if (objects_.FindUnknown(T_world_camera, num_inliers) == 0) return {};
  FrameFeatures features;
  features.keypoints = data.features.keypoints;
  return Label(features);
}

cv::Mat FrameObserver::RestingDepth(const cv::Mat& depth_m) const {
  cv::Mat depth_mm = MakeDepthThumbnail(depth_m);
  if (depth_mm.empty() || !options_.objects.enabled) return depth_mm;
  const cv::Mat mask = objects_.DynamicMask();
  if (mask.size() == depth_mm.size()) depth_mm.setTo(0, RecordedMask(mask, camera_));
  return depth_mm;
}

void FrameObserver::Settle(const std::optional<Se3>& T_world_camera, TrackingResult& result) {
  if (!options_.objects.enabled) return;
  if (T_world_camera) {
    objects_.Settle(*T_world_camera, Eigen::Matrix3d::Zero());
  } else {
    objects_.SettleLost();
  }
  result.objects = objects_.objects();
}

void FrameObserver::StartWorld() {
  objects_.StartWorld();
}

void FrameObserver::Clear() {
  objects_.Clear();
}

}  // namespace cslam
