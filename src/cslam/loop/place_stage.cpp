// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/place_stage.h"

#include "cslam/util/options.h"

namespace cslam {

void Describe(OptionList& list, PlaceOptions& o) {
  list.Add("close_loops", o.close_loops,
           "Correct the map where a place is seen again, and merge maps that share one; without it "
           "circuits are not adjusted either.");
  list.Add("relocalise", o.relocalise, "Look for the place of frames that tracking lost.");
  list.Group("index", o.index);
  list.Group("loop", o.loop);
  list.Group("circuit", o.circuit);
  list.Group("relocaliser", o.relocaliser);
}

PlaceStage::PlaceStage(const Camera& camera, const OrbOptions& orb, const DepthOptions& depth,
                       const PlaceOptions& options)
    : options_(options),
      index_(options.index),
      closer_(MakePlaceSensor(camera, orb, depth), options.loop),
      circuits_(options.circuit),
      relocaliser_(MakePlaceSensor(camera, orb, depth), options.relocaliser) {}

PlaceOutcome PlaceStage::OnKeyframe(KeyframeId keyframe, const MapSnapshot& snapshot) {
  const Keyframe* seen = snapshot.map.FindKeyframe(keyframe);
  if (seen == nullptr) return {};  // culled at once
  PlaceOutcome outcome;
  if (options_.close_loops) outcome.loop = closer_.Process(keyframe, snapshot.map, index_);
  if (outcome.loop.correction) {
    circuits_.Reset();
  } else if (options_.close_loops) {
    outcome.closes_circuit = circuits_.IsClosedBy(*seen, snapshot.map);
  }
  File(*seen, snapshot.map);
  return outcome;
}

void PlaceStage::File(const Keyframe& keyframe, const MapView& map) {
  index_.Add(keyframe.id,
             SelectDescriptors(keyframe.data->features, PlaceKeypoints(map, keyframe)));
}

void PlaceStage::Continue(const MapSnapshot& snapshot) {
  Reset();
  for (const KeyframeId id : snapshot.map.Keyframes())
    File(*snapshot.map.FindKeyframe(id), snapshot.map);
}

PlaceHint PlaceStage::Find(const LostFrame& frame, const MapSnapshot& snapshot) const {
  PlaceHint hint;
  hint.frame = frame.data->frame;
  hint.stamp = frame.data->stamp;
  const RelocalisationResult result =
      relocaliser_.Find(frame.data->features, snapshot.map, index_, {}, frame.data->depth_small_mm);
  hint.reason = result.reason;
  if (!result.found) return hint;
  hint.is_found = true;
  hint.reference = result.found->reference;
  hint.T_reference_camera = result.found->T_reference_camera;
  return hint;
}

void PlaceStage::Reset() {
  index_ = PlaceIndex(options_.index);
  closer_.Reset();
  circuits_.Reset();
}

}  // namespace cslam
