// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/pipeline/frame_localiser.h"

#include "cslam/util/stopwatch.h"

#include <utility>

namespace cslam {

FrameLocaliser::FrameLocaliser(std::shared_ptr<const MapSnapshot> map, const Camera& camera,
                               const SlamOptions& options, std::unique_ptr<Detector> detector)
    : map_(std::move(map)),
      options_(options),
      detector_(std::move(detector)),
      observer_(camera, options_.tracking),
      places_(camera, options.tracking.orb, options.tracking.depth, options.places) {
  places_.Continue(*map_);
}

LocalisedFrame FrameLocaliser::Find(const RgbdFrame& frame) {
  std::optional<Detections> detections;
  if (detector_) detections = detector_->Detect(frame);
  TrackingResult ignored;
  observer_.Clear();
  const auto data =
      observer_.Observe(frame, std::nullopt, detections ? &*detections : nullptr, ignored);
  data->depth_small_mm = observer_.RestingDepth(frame.depth_m);
  const Stopwatch watch;
  const PlaceHint hint = places_.Find(LostFrame{data}, *map_);
  LocalisedFrame found;
  found.frame = frame.id;
  found.stamp = frame.stamp;
  found.reason = hint.reason;
  found.find_ms = watch.Elapsed().cpu_ms;
  if (!hint.is_found) return found;
  const Keyframe& reference = *map_->map.FindKeyframe(hint.reference);
  found.T_world_camera = reference.T_world_camera * hint.T_reference_camera;
  found.map = reference.map;
  return found;
}

}  // namespace cslam
