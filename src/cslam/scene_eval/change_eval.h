// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/report_files.h"
#include "cslam/scene_eval/knowable_changes.h"
#include "cslam/scene_eval/scene_run.h"
#include "cslam/scene_eval/scene_score.h"

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

// How well the changes that a run reports are the true ones.

namespace cslam {

enum class ChangeVerdict {
  kMatched,
  kFalse,
  kEarly,      // right, but told before any part of it came into view
  kPart,       // only a part of a true change: a thing's removal where it was moved
  kNotJudged,  // of a change nobody could know of
};

struct JudgedChange {
  KnowableChange truth = {};
  std::optional<std::size_t> report = {};  // index of the report it is matched with
  bool is_partial = false;                 // missed, but a part of it was told
  bool is_early = false;                   // missed, for it was told too early
  // From when all of it could be known to the report, s; 0 if it was told with less.
  std::optional<double> delay_s = {};
  // From the first clear view of the old place alone to the report, s.
  std::optional<double> delay_from_old_place_s = {};
};

struct JudgedReport {
  ReportedChange report = {};  // in the frame of the truth
  double time_s = 0.0;         // reported, since the sequence's start
  ChangeVerdict verdict = ChangeVerdict::kFalse;
};

struct ChangeEvaluation {
  std::vector<JudgedChange> changes;           // true ones, in order of time
  std::vector<JudgedReport> reports;           // of the classes asked for, in order of time
  std::map<ChangeKind, DetectionScore> kinds;  // all four
  DetectionScore all;
  int num_partial = 0;
  int num_early = 0;
  int num_other_classes = 0;  // reports of classes nobody asked for
  std::optional<double> median_delay_s;
  std::optional<double> max_delay_s;
};

ChangeEvaluation EvaluateChanges(const SceneTruth& truth, const SceneRun& run,
                                 const SceneEvalOptions& options = {});

// The same for known changes: pure. start: stamp of time 0.
ChangeEvaluation JudgeChanges(std::vector<KnowableChange> changes,
                              const std::vector<ReportedChange>& reports, Stamp start,
                              const SceneEvalOptions& options);

}  // namespace cslam
