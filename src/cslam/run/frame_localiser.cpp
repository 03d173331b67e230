// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/frame_localiser.h"

#include "cslam/atlas_io/map_export.h"
#include "cslam/eval/ate.h"
#include "cslam/util/check.h"
#include "cslam/util/stopwatch.h"
#include "cslam/vision/depth_thumbnail.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace cslam {
namespace {

// Stamps of another recording fit by chance only, and then the shapes do not.
constexpr double kMaxKeyframeRmseM = 0.2;

std::set<MapId> MapsOf(const MapView& map) {
  std::set<MapId> maps;
  for (const KeyframeId id : map.Keyframes())
    maps.insert(map.FindKeyframe(id)->map);
  return maps;
}

}  // namespace

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

std::optional<Se3> PoseAt(const Trajectory& truth, Stamp stamp) {
  const PoseAssociationOptions options{.mode = PoseAssociationMode::kInterpolate};
  const PoseAssociation association = AssociatePoses(truth, {{stamp, Se3()}}, options);
  if (association.pairs.empty()) return std::nullopt;
  return association.pairs.front().reference;
}

MapTruth::MapTruth(const MapView& map, Trajectory truth) : truth_(std::move(truth)) {
  for (const MapId id : MapsOf(map)) {
    try {
      const AteResult ate = EvaluateAte(truth_, KeyframeTrajectory(map, id));
      if (ate.alignment.rmse_m > kMaxKeyframeRmseM || !ate.alignment.is_unique) {
        throw Error("{} of its keyframes have a stamp of the truth, with {:.2f} m between them",
                    ate.association.pairs.size(), ate.alignment.rmse_m);
      }
      alignments_[id] = ate.alignment;
    } catch (const Error& error) {
      problems_.push_back(
          fmt::format("map {} does not fit the ground truth: {}", id.value(), error.what()));
    }
  }
}

std::optional<PoseDifference> MapTruth::ErrorOf(const LocalisedFrame& frame) const {
  const auto alignment = alignments_.find(frame.map);
  const auto truth = PoseAt(truth_, frame.stamp);
  if (!frame.T_world_camera || !truth || alignment == alignments_.end()) return std::nullopt;
  return Difference(*truth, Align(alignment->second, *frame.T_world_camera));
}

double MapTruth::KeyframeRmse() const {
  double largest_m = 0.0;
  for (const auto& [id, alignment] : alignments_)
    largest_m = std::max(largest_m, alignment.rmse_m);
  return largest_m;
}

}  // namespace cslam
