// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/pipeline/executor.h"

namespace cslam {

Slam::InlineExecutor::InlineExecutor(const Camera& camera, const SlamOptions& options, Sinks sinks,
                                     std::unique_ptr<Detector> detector)
    : detector_(std::move(detector)),
      detection_(detector_.get(), options.detection),
      tracker_(camera, options.tracking),
      mapper_(camera, options.tracking.orb, options.tracking.depth, options.mapping),
      sinks_(std::move(sinks)) {}

TrackingResult Slam::InlineExecutor::Track(std::shared_ptr<const RgbdFrame> frame) {
  TrackerOutput output = tracker_.Process(*frame, snapshot_, detection_.Next(*frame));
  records_.push_back(MakeRecord(output.result));
  for (const auto& sink : sinks_)
    sink->OnFrame(output.result);
  if (output.proposal) {
    const MapUpdate inserted = mapper_.Insert(*output.proposal);
    Publish(inserted);
    if (inserted.step == MapUpdate::Step::kInserted) Publish(mapper_.Refine());
  }
  return std::move(output.result);
}

void Slam::InlineExecutor::Publish(const MapUpdate& update) {
  snapshot_ = update.snapshot;
  for (const auto& sink : sinks_)
    sink->OnMap(update);
}

void Slam::InlineExecutor::Reset() {
  detection_.Reset();
  tracker_.Reset();
  mapper_.Reset();
  snapshot_.reset();
  records_.clear();
}

RunResult Slam::InlineExecutor::Finish() {
  RunResult result;
  result.frames = std::move(records_);
  result.snapshot = snapshot_ ? snapshot_ : std::make_shared<const MapSnapshot>();
  for (const auto& sink : sinks_)
    sink->OnFinish(result);
  return result;
}

}  // namespace cslam
