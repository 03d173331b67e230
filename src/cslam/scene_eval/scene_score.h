// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/truth_files.h"
#include "cslam/scene_eval/clear_view.h"
#include "cslam/scene_eval/scene_run.h"

#include <optional>
#include <set>

namespace cslam {

struct SceneEvalOptions {
  double max_distance_m = 0.5;  // between a thing's true and reported middle (of the issue)
  std::set<int> classes = {};   // COCO; empty: all of the truth but people
  ClearViewOptions clear_view = {};
};

// The same with classes filled in: those of the truth but people, unless some are asked for.
SceneEvalOptions WithKnownClasses(const SceneEvalOptions& options, const TrueObjects& objects);

// The same with views left out that neither the run nor the session before it had.
SceneEvalOptions WithGapOf(const SceneEvalOptions& options, const SceneTruth& truth,
                           const SceneRun& run);

// Counts of a score. Undefined shares (nothing to divide by) are nothing.
struct DetectionScore {
  int num_true = 0;      // that could be known
  int num_reported = 0;  // that can be judged
  int num_matched = 0;

  std::optional<double> Precision() const;
  std::optional<double> Recall() const;
  std::optional<double> F1() const;
  DetectionScore& operator+=(const DetectionScore& other);
};

}  // namespace cslam
