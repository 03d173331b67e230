// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/pipeline/threaded_stages.h"

namespace cslam {

Slam::ThreadedExecutor::ThreadedExecutor(const Camera& camera, const SlamOptions& options,
                                         Sinks sinks, FeedPolicy feed_policy,
                                         std::unique_ptr<Detector> detector)
    : stages_(std::make_unique<Stages>(camera, options, std::move(sinks), feed_policy,
                                       std::move(detector))) {}

Slam::ThreadedExecutor::~ThreadedExecutor() = default;

TrackingResult Slam::ThreadedExecutor::Track(std::shared_ptr<const RgbdFrame> frame) {
  auto promise = std::make_shared<std::promise<TrackingResult>>();
  auto answer = promise->get_future();
  stages_->frames.Push({.frame = std::move(frame),
                        .detections = nullptr,
                        .answer = std::move(promise),
                        .mode = mode_,
                        .reset = {}});
  return stages_->WaitFor(std::move(answer));
}

void Slam::ThreadedExecutor::Feed(std::shared_ptr<const RgbdFrame> frame) {
  stages_->WaitForStagesBehind();
  stages_->frames.Push({.frame = std::move(frame),
                        .detections = nullptr,
                        .answer = nullptr,
                        .mode = mode_,
                        .reset = {}});
  stages_->RethrowFailure();
}

// Waits, so that no frame that comes later can push the request out of a queue that drops.
void Slam::ThreadedExecutor::ResetOrContinue(std::shared_ptr<Map> map) {
  auto promise = std::make_shared<std::promise<void>>();
  auto done = promise->get_future();
  stages_->frames.PushFeedback(
      {.frame = nullptr,
       .detections = nullptr,
       .answer = nullptr,
       .mode = mode_,
       .reset = {.done = std::move(promise), .map = std::move(map), .snapshot = nullptr}});
  stages_->WaitFor(std::move(done));
}

RunResult Slam::ThreadedExecutor::Finish() {
  // Closing the first channel drains the line: each stage closes the next when it is done.
  stages_->frames.Close();
  stages_->Join();
  stages_->RethrowFailure();
  RunResult result;
  result.frames = std::move(stages_->records);
  result.snapshot = stages_->latest.Get();
  if (!result.snapshot) result.snapshot = std::make_shared<const MapSnapshot>();
  result.frames_dropped = stages_->frames.stats().dropped;
  for (const auto& sink : stages_->sinks)
    sink->OnFinish(result);
  return result;
}

std::shared_ptr<const MapSnapshot> Slam::ThreadedExecutor::map() const {
  return stages_->latest.Get();
}

}  // namespace cslam
