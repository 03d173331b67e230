// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/semantics/detector.h"

#include <deque>
#include <memory>
#include <string>

namespace cslam {

class OptionList;

// When the detector looks at frames, and when the tracker gets to know.
enum class DetectionSchedule {
  kEveryFrame,  // the tracker waits for this frame's detections (the paper)
  kLive,        // the detector looks at some frames, the tracker never waits for it
};

struct DetectionOptions {
  std::string schedule = "auto";  // "auto", "every-frame" or "live"
  int live_stride = 2;            // frames from one that the detector looks at to the next
  int live_max_ahead = 2;         // frames that --rate max may run ahead of the detector
  int live_delay_frames = 2;      // inline only: a result becomes visible so many frames later
  int detector_nice = 2;          // how much lower the detector thread's priority is
};
void Describe(OptionList& list, DetectionOptions& options);

// auto: every frame inline, live threaded. Throws Error for an unknown name.
DetectionSchedule ScheduleOf(const DetectionOptions& options, bool is_inline);

// Runs a detector on the caller's thread by either schedule, the live one with a fixed delay, so
// that carrying late detections forward can be repeated bit for bit.
class InlineDetection {
 public:
  InlineDetection(Detector* detector, const DetectionOptions& options);

  // The newest detections that the tracker may know when it processes frame; null: none.
  // Call once a frame.
  const Detections* Next(const RgbdFrame& frame);

  void Reset();

 private:
  struct Pending {
    std::int64_t visible_from = 0;
    Detections detections;
  };
  Detector* detector_;  // null: no detections at all
  DetectionOptions options_;
  DetectionSchedule schedule_;
  std::int64_t num_frames_ = 0;
  std::deque<Pending> pending_;
  std::optional<Detections> visible_;
};

}  // namespace cslam
