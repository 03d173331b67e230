// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/scene_eval/object_eval.h"
#include "cslam/scene_eval/scene_run.h"
#include "cslam/scene_eval/scene_score.h"
#include "cslam/scene_eval/scene_truth.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

// Whether a map is free of what has gone, and still has what is there.

namespace cslam {

struct GhostOptions {
  double box_margin_m = 0.05;        // points so near to a former object's box may be its ghosts
  double surface_distance_m = 0.05;  // but not if they are so near to something present
  int min_surface_frames = 2;        // that see the surface there: depth at edges may be anything
  std::size_t max_frames = 150;      // looked at per former place, evenly spread
  ClearViewOptions clear_view = {};
};

struct GhostCount {
  std::size_t num_points = 0;  // active ones, of the whole map
  int num_former_places = 0;   // left by something, and clearly seen afterwards
  std::vector<Eigen::Vector3d> ghosts;

  std::optional<double> Share() const;  // 0 to 1; nothing for an empty map
};

// A ghost lies within a margin of the box of an object that has left and whose place (or what has
// replaced it there) was clearly seen again, and no depth image after it left shows a surface near
// it (people do not count). Of all classes, with name or without. Throws Error if the run has no
// map.ply.
GhostCount CountGhosts(const SceneTruth& truth, const SceneRun& run,
                       const GhostOptions& options = {});

// Of points of objects that are present, correctly so, and first seen at least so long before the
// end: the share that is active.
struct ActiveShare {
  int num_points = 0;
  int num_active = 0;

  std::optional<double> Share() const;
};
constexpr double kSettledAfterS = 5.0;
ActiveShare ShareOfActivePoints(const ObjectEvaluation& evaluation, Stamp last_stamp,
                                double settled_after_s = kSettledAfterS);

}  // namespace cslam
