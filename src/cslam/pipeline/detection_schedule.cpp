// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/pipeline/detection_schedule.h"

#include "cslam/util/check.h"
#include "cslam/util/options.h"

#include <utility>

namespace cslam {

void Describe(OptionList& list, DetectionOptions& o) {
  list.Add("schedule", o.schedule,
           "every-frame: tracking waits for each frame's detections; live: it never waits, and "
           "carries the newest ones forward; auto: live if threaded, else every-frame.");
  list.Add("live_stride", o.live_stride, {1, 1000}, "frames",
           "live: frames from one that the detector looks at to the next.");
  list.Add("live_max_ahead", o.live_max_ahead, {0, 100000}, "frames",
           "live, at --rate max: the source waits while the newest frame that the detector has "
           "looked at is more than this and live_stride behind, so that a slow or busy machine "
           "makes a run longer, but not blinder than at the sensor's rate.");
  list.Add("live_delay", o.live_delay_frames, {0, 1000}, "frames",
           "live, inline: detections become visible so many frames after their own.");
  list.Add("detector_nice", o.detector_nice, {0, 19}, "",
           "How much lower the detector thread's priority is than the tracking thread's.");
}

DetectionSchedule ScheduleOf(const DetectionOptions& options, bool is_inline) {
  if (options.schedule == "every-frame") return DetectionSchedule::kEveryFrame;
  if (options.schedule == "live") return DetectionSchedule::kLive;
  if (options.schedule == "auto") {
    return is_inline ? DetectionSchedule::kEveryFrame : DetectionSchedule::kLive;
  }
  throw Error("unknown detection schedule '{}'; it is one of: auto, every-frame, live",
              options.schedule);
}

InlineDetection::InlineDetection(Detector* detector, const DetectionOptions& options)
    : detector_(detector), options_(options), schedule_(ScheduleOf(options, true)) {}

const Detections* InlineDetection::Next(const RgbdFrame& frame) {
  if (detector_ == nullptr) return nullptr;
  const std::int64_t index = num_frames_++;
  if (schedule_ == DetectionSchedule::kEveryFrame) {
    visible_ = detector_->Detect(frame);
    return &*visible_;
  }
  if (index % options_.live_stride == 0) {
    // The first frame's are waited for: a map should not start with people in it.
    const std::int64_t delay = index == 0 ? 0 : options_.live_delay_frames;
    pending_.push_back({index + delay, detector_->Detect(frame)});
  }
  while (!pending_.empty() && pending_.front().visible_from <= index) {
    visible_ = std::move(pending_.front().detections);
    pending_.pop_front();
  }
  return visible_ ? &*visible_ : nullptr;
}

void InlineDetection::Reset() {
  num_frames_ = 0;
  pending_.clear();
  visible_.reset();
}

}  // namespace cslam
