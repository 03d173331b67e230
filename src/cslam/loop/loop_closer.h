// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/loop/depth_check.h"
#include "cslam/loop/geometric_verification.h"
#include "cslam/loop/loop_fusion.h"
#include "cslam/loop/loop_options.h"
#include "cslam/loop/place_index.h"
#include "cslam/map/map_view.h"
#include "cslam/messages/loop_messages.h"

#include <optional>
#include <utility>
#include <vector>

namespace cslam {

struct LoopOutcome {
  std::vector<LoopRecord> records;  // one per candidate looked at
  std::optional<MapCorrection> correction;
};

// Looks for places seen before and works out how the map has to change. Synchronous and
// single-threaded; reads snapshots only:
//
//   LoopOutcome outcome = closer.Process(id, snapshot->map, index);   // for every new keyframe
//   if (outcome.correction) mapper applies it; the next call gets a snapshot that has it.
//   index.Add(id, ...);
//
// A place counts as found when several keyframes have been verified against it and agree where it
// is. Then the pose graph is solved, and what it says has to fit the depth both sides measured.
class LoopCloser {
 public:
  LoopCloser(PlaceSensor sensor, const LoopOptions& options);

  // keyframe: the one inserted last; nothing happens if it has been culled already. The index may
  // hold keyframes the map no longer has.
  LoopOutcome Process(KeyframeId keyframe, const MapView& map, const PlaceIndex& index);

  // Forgets what is pending.
  void Reset();

 private:
  // A place found by one keyframe at least, and not yet by enough.
  struct Hypothesis {
    LoopEdge loop;      // as found last
    int sightings = 1;  // by keyframes that were processed
    int missed = 0;     // processed since without finding it
  };

  LoopRecord Examine(const Keyframe& query, const PlaceCandidate& candidate, const MapView& map,
                     const PointFilter& may_use) const;
  bool Agree(const LoopEdge& a, const LoopEdge& b, const MapView& map) const;
  int CountConfirmingNeighbours(const LoopEdge& loop, const MapView& map,
                                const PointFilter& may_use, int max_count) const;
  void Consider(LoopRecord& record, const MapView& map, const PointFilter& may_use);
  void MissOne();
  std::optional<MapCorrection> Close(LoopRecord& record, const MapView& map);
  MapCorrection Solve(const LoopRecord& record, const MapView& map) const;
  DepthComparison CompareSides(const LoopEdge& loop, const CorrectedView& view) const;

  const PlaceSensor sensor_;
  const LoopOptions options_;
  std::optional<Hypothesis> pending_;
};

}  // namespace cslam
