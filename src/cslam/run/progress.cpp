// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace cslam {
namespace {

constexpr double kBarIntervalMs = 100.0;
constexpr std::size_t kBarWidth = 24;

std::string Bar(std::size_t done, std::size_t total) {
  const std::size_t filled = total == 0 ? 0 : std::min(kBarWidth, done * kBarWidth / total);
  return fmt::format("[{:#<{}}{:.<{}}]", "", filled, "", kBarWidth - filled);
}

bool IsLost(TrackingState state) {
  return state == TrackingState::kRecentlyLost || state == TrackingState::kLost;
}

}  // namespace

ProgressSink::ProgressSink(std::FILE* stream, const ProgressOptions& options)
    : stream_(stream), options_(options) {
  if (options_.style == ProgressStyle::kBar) options_.interval_ms = kBarIntervalMs;
}

ProgressSink::~ProgressSink() {
  ClearBar();
}

void ProgressSink::OnFrame(const TrackingResult& result) {
  ++num_processed_;
  TellStateChange(result);
  if (since_drawn_.ElapsedMs() < options_.interval_ms) return;
  since_drawn_.Lap();
  Draw(result);
}

void ProgressSink::OnMap(const MapUpdate& update) {
  num_keyframes_ = update.snapshot->map.num_keyframes();
}

void ProgressSink::OnFinish(const RunResult& /*result*/) {
  ClearBar();
}

void ProgressSink::TellStateChange(const TrackingResult& result) {
  const TrackingState before = std::exchange(state_, result.state);
  if (before == state_ || !(IsLost(before) || IsLost(state_))) return;
  ClearBar();
  Say(fmt::format("frame {} ({} s): {}: {}\n", result.frame.value(), FormatStamp(result.stamp),
                  ToString(state_), result.reason));
}

void ProgressSink::Draw(const TrackingResult& result) {
  const std::size_t done =
      result.frame.index() + 1 - std::min(result.frame.index() + 1, options_.first_frame);
  const double fps = 1e3 * static_cast<double>(num_processed_) / since_start_.ElapsedMs();
  const std::string text = fmt::format("frame {} of {}, {}, {} inliers, {} keyframes, {:.0f} fps",
                                       done, options_.num_frames, ToString(result.state),
                                       result.num_inliers, num_keyframes_, fps);
  if (options_.style == ProgressStyle::kLines) {
    Say(text + '\n');
    return;
  }
  Say(fmt::format("\r\033[K{} {}", Bar(done, options_.num_frames), text));
  has_bar_ = true;
}

// A stream that takes nothing more must not end the run.
void ProgressSink::Say(const std::string& text) {
  std::fputs(text.c_str(), stream_);
  std::fflush(stream_);
}

void ProgressSink::ClearBar() {
  if (!has_bar_) return;
  Say("\r\033[K");
  has_bar_ = false;
}

}  // namespace cslam
