// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/pipeline/slam.h"

#include "cslam/pipeline/executor.h"
#include "cslam/util/check.h"
#include "cslam/util/options.h"

#include <opencv2/core/utility.hpp>

namespace cslam {
namespace {

void CheckOptions(const Camera& camera, SlamOptions options) {
  if (const std::string why = WhyInvalid(camera); !why.empty()) {
    throw Error("unusable camera: {}", why);
  }
  OptionList list;
  Describe(list, options);
  list.CheckRanges();
}

}  // namespace

namespace {

// Tracker and mapper go by the same knowledge of objects; the user gives it once.
SlamOptions WithSharedKnowledge(SlamOptions options) {
  options.tracking.watch.enabled =
      options.tracking.watch.enabled && options.mapping.objects.enabled;
  options.tracking.watch.classes = options.mapping.objects.classes;
  options.tracking.watch.belief = options.mapping.objects.belief;
  options.tracking.watch.view = options.mapping.objects.view;
  return options;
}

}  // namespace

Slam::Slam(const Camera& camera, const SlamOptions& given, Execution execution,
           std::vector<std::shared_ptr<OutputSink>> sinks, FeedPolicy feed_policy,
           std::unique_ptr<Detector> detector)
    : camera_(camera) {
  const SlamOptions options = WithSharedKnowledge(given);
  CheckOptions(camera, options);
  cv::setNumThreads(options.pipeline.library_threads);
  if (execution == Execution::kInline) {
    executor_ =
        std::make_unique<InlineExecutor>(camera, options, std::move(sinks), std::move(detector));
  } else {
    executor_ = std::make_unique<ThreadedExecutor>(camera, options, std::move(sinks), feed_policy,
                                                   std::move(detector));
  }
}

Slam::~Slam() = default;

void Slam::CheckFrame(const RgbdFrame& frame) {
  const auto has_camera_size = [&](const cv::Mat& image) {
    return image.cols == camera_.width && image.rows == camera_.height;
  };
  if (frame.gray.type() != CV_8UC1 || !has_camera_size(frame.gray)) {
    throw Error("frame {}: the grey image is {}x{} of type {}, the camera needs {}x{} CV_8UC1",
                frame.id.value(), frame.gray.cols, frame.gray.rows, frame.gray.type(),
                camera_.width, camera_.height);
  }
  if (frame.depth_m.type() != CV_32FC1 || !has_camera_size(frame.depth_m)) {
    throw Error("frame {}: the depth image is {}x{} of type {}, the camera needs {}x{} CV_32FC1",
                frame.id.value(), frame.depth_m.cols, frame.depth_m.rows, frame.depth_m.type(),
                camera_.width, camera_.height);
  }
  if (has_last_stamp_ && frame.stamp <= last_stamp_) {
    throw Error("frame {}: stamp {} does not come after {}", frame.id.value(),
                FormatStamp(frame.stamp), FormatStamp(last_stamp_));
  }
  CSLAM_CHECK(!is_finished_, "a frame after Finish()");
  last_stamp_ = frame.stamp;
  has_last_stamp_ = true;
}

TrackingResult Slam::Track(std::shared_ptr<const RgbdFrame> frame) {
  CheckFrame(*frame);
  return executor_->Track(std::move(frame));
}

void Slam::Feed(std::shared_ptr<const RgbdFrame> frame) {
  CheckFrame(*frame);
  executor_->Feed(std::move(frame));
}

std::shared_ptr<const MapSnapshot> Slam::map() const {
  return executor_->map();
}

void Slam::Reset() {
  executor_->Reset();
  has_last_stamp_ = false;
}

void Slam::Continue(Map map) {
  CSLAM_CHECK(!is_finished_, "Continue() after Finish()");
  executor_->Continue(std::move(map));
  has_last_stamp_ = false;
}

void Slam::SetMode(TrackingMode mode) {
  executor_->SetMode(mode);
}

const RunResult& Slam::Finish() {
  if (!is_finished_) {
    is_finished_ = true;
    result_ = executor_->Finish();
  }
  return result_;
}

}  // namespace cslam
