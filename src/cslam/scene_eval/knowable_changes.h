// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/visibility.h"
#include "cslam/io/truth_files.h"
#include "cslam/scene_eval/scene_score.h"
#include "cslam/scene_eval/scene_truth.h"

#include <optional>
#include <string>
#include <vector>

// Which of the true changes a camera could know of, and from when.

namespace cslam {

// Times are seconds since the sequence's start.
struct KnowableChange {
  TrueChange change =
      {};               // of several the camera could not tell apart: the first and the last in one
  int num_merged = 1;   // how many of changes.json it stands for
  double left_s = 0.0;  // when the old place was left; without one, when the new one was taken
  double arrived_s = 0.0;                    // when the new place was taken; without one, as left_s
  std::optional<Eigen::Vector3d> from = {};  // middles of the boxes
  std::optional<Eigen::Vector3d> to = {};
  // First clear views: of the old place afterwards, and of the thing at the new one.
  std::optional<double> old_view_s = {};
  std::optional<double> new_view_s = {};
  // First time that any part worth speaking of was in view: of the old place, or of the thing at
  // the new one. Nobody can tell of the change before.
  std::optional<double> first_glimpse_s = {};
  // If num_merged > 1, what it stands for, in order. Who tells all of them is right as well: less
  // than a clear view was enough.
  std::vector<KnowableChange> parts = {};
  // Why nobody could know of it; empty: it counts.
  std::string why_not = {};

  bool counts() const { return why_not.empty(); }
  double known_s() const;  // from when all of it could be known: later than any report if never
};

// Changes of the classes asked for (of a replaced thing and what came both) from start_s to end_s,
// in order of time. Several changes of one thing between which nobody looked become one; if they
// cancel out, one that does not count. One that counts was seen before (an added thing's place
// without it) and its places are clearly seen afterwards: the old one of a removal, the new one of
// an addition and of a replacement, both of a move.
std::vector<KnowableChange> KnowableChanges(const SceneTruth& truth, double start_s, double end_s,
                                            const SceneEvalOptions& options);

}  // namespace cslam
