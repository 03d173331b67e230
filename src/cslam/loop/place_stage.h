// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/loop/circuit_watch.h"
#include "cslam/loop/loop_closer.h"
#include "cslam/loop/place_index.h"
#include "cslam/loop/relocaliser.h"
#include "cslam/messages/messages.h"
#include "cslam/messages/place_hint.h"

#include <memory>

namespace cslam {

class OptionList;

struct PlaceOptions {
  bool close_loops = true;
  bool relocalise = true;
  PlaceIndexOptions index;
  LoopOptions loop;
  CircuitOptions circuit;
  RelocaliserOptions relocaliser;
};
void Describe(OptionList& list, PlaceOptions& options);

struct PlaceOutcome {
  LoopOutcome loop;
  bool closes_circuit = false;  // without a loop: its map is to be adjusted as a whole
};

// All that recognises places: the index of keyframes, loop closing and relocalisation. Synchronous
// and single-threaded; reads snapshots only.
class PlaceStage {
 public:
  PlaceStage(const Camera& camera, const OrbOptions& orb, const DepthOptions& depth,
             const PlaceOptions& options);

  // For every keyframe once the mapper has refined it: looks for places seen before, then files it.
  PlaceOutcome OnKeyframe(KeyframeId keyframe, const MapSnapshot& snapshot);

  // Searches all maps for the place of a frame that tracking lost.
  PlaceHint Find(const LostFrame& frame, const MapSnapshot& snapshot) const;

  void Reset();

  // The same, and files the keyframes of a map of an earlier run.
  void Continue(const MapSnapshot& snapshot);

 private:
  void File(const Keyframe& keyframe, const MapView& map);

  const PlaceOptions options_;
  PlaceIndex index_;
  LoopCloser closer_;
  CircuitWatch circuits_;
  Relocaliser relocaliser_;
};

}  // namespace cslam
