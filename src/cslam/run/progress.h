// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/pipeline/sink.h"
#include "cslam/util/stopwatch.h"

#include <cstddef>
#include <cstdio>
#include <string>

namespace cslam {

enum class ProgressStyle {
  kBar,    // one line that is redrawn: for terminals
  kLines,  // a line every few seconds: for logs
};

struct ProgressOptions {
  ProgressStyle style = ProgressStyle::kLines;
  std::size_t first_frame = 0;  // id of the first frame to come
  std::size_t num_frames = 0;   // that are to come
  double interval_ms = 3000.0;  // between two lines; bars are redrawn ten times a second
};

// Tells on a stream how far a run is, and every loss and recovery of tracking with its reason.
class ProgressSink : public OutputSink {
 public:
  // The stream must outlive this.
  ProgressSink(std::FILE* stream, const ProgressOptions& options);
  ~ProgressSink() override;  // a run that ends with an error leaves no bar behind
  ProgressSink(const ProgressSink&) = delete;
  ProgressSink& operator=(const ProgressSink&) = delete;

  void OnFrame(const TrackingResult& result) override;
  void OnMap(const MapUpdate& update) override;
  void OnFinish(const RunResult& result) override;

 private:
  void TellStateChange(const TrackingResult& result);
  void Draw(const TrackingResult& result);
  void Say(const std::string& text);
  void ClearBar();

  std::FILE* stream_;
  ProgressOptions options_;
  Stopwatch since_start_;
  Stopwatch since_drawn_;
  TrackingState state_ = TrackingState::kInitialising;
  std::size_t num_processed_ = 0;
  std::size_t num_keyframes_ = 0;
  bool has_bar_ = false;
};

}  // namespace cslam
