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
      places_(camera, options.tracking.orb, options.tracking.depth, options.places),
      adjuster_(camera, options),
      sinks_(std::move(sinks)) {}

TrackingResult Slam::InlineExecutor::Track(std::shared_ptr<const RgbdFrame> frame) {
  TrackerOutput output =
      tracker_.Process(*frame, snapshot_, detection_.Next(*frame), hint_ ? &*hint_ : nullptr);
  hint_.reset();
  if (output.lost) hint_ = places_.Find(*output.lost, *snapshot_);
  records_.push_back(MakeRecord(output.result));
  for (const auto& sink : sinks_)
    sink->OnFrame(output.result);
  if (output.proposal) {
    const MapUpdate inserted = mapper_.Insert(*output.proposal);
    Publish(inserted);
    if (inserted.step == MapUpdate::Step::kInserted) {
      Publish(mapper_.Refine());
      RecognisePlaces(inserted.keyframe);
    }
  }
  return std::move(output.result);
}

void Slam::InlineExecutor::RecognisePlaces(KeyframeId keyframe) {
  const PlaceOutcome outcome = places_.OnKeyframe(keyframe, *snapshot_);
  for (const LoopRecord& record : outcome.loop.records) {
    for (const auto& sink : sinks_)
      sink->OnLoop(record);
  }
  if (outcome.closes_circuit) AdjustFully(snapshot_->map.FindKeyframe(keyframe)->map);
  if (!outcome.loop.correction) return;
  const MapUpdate corrected = mapper_.Apply(*outcome.loop.correction);
  Publish(corrected);
  if (corrected.correction->is_applied()) AdjustFully(MapAfter(*outcome.loop.correction));
}

void Slam::InlineExecutor::AdjustFully(MapId map) {
  if (const auto refinement = adjuster_.Adjust(*snapshot_, map))
    Publish(mapper_.Apply(*refinement));
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
  places_.Reset();
  hint_.reset();
  snapshot_.reset();
  records_.clear();
}

void Slam::InlineExecutor::Continue(Map map) {
  Reset();
  Publish(mapper_.Continue(std::move(map)));
  tracker_.Continue(snapshot_->map);
  places_.Continue(*snapshot_);
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
