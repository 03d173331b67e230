// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/scene_eval/scene_report.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

namespace cslam {

// What a benchmark keeps of one run. Absent: not measured, or undefined.
struct RunFigures {
  std::optional<double> ate_m;          // RMSE
  std::optional<double> tracked_share;  // of the frames, in the trajectory
  std::optional<double> loops;          // accepted ones
  std::optional<double> false_loops;
  std::optional<double> object_f1;
  std::optional<double> object_precision;
  std::optional<double> object_recall;
  std::optional<double> change_f1;
  std::optional<double> change_precision;
  std::optional<double> change_recall;
  std::optional<double> objects_true;  // counts, see DetectionScore
  std::optional<double> objects_reported;
  std::optional<double> objects_matched;
  std::optional<double> changes_true;
  std::optional<double> changes_reported;
  std::optional<double> changes_matched;
  std::optional<double> ghost_share;
  std::optional<double> active_share;
  std::optional<double> delay_s;  // of reported changes, median
  std::optional<double> max_delay_s;
  std::optional<double> tracking_ms;  // medians, wall time
  std::optional<double> mapping_ms;
  std::optional<double> memory_mb;
  std::optional<double> run_s;
};

// One of them, and how it is shown.
struct FigureInfo {
  std::string_view key;      // in JSON
  std::string_view heading;  // of a column
  std::optional<double> RunFigures::*value;
  double factor = 1.0;  // from the value to what is shown
  int decimals = 0;
};

// All of them, in order of declaration.
std::span<const FigureInfo> AllFigures();
// Throws InternalError for a key there is not.
const FigureInfo& FigureOf(std::string_view key);

// A run held against the truth of its sequence.
struct RunEvaluation {
  RunFigures figures;
  ObjectReport objects;
  ChangeReport changes;
};

// What run.json alone tells.
RunFigures ReadRunFigures(const std::filesystem::path& run_folder);
// The rest as well. Throws Error for broken files.
RunEvaluation EvaluateRun(const SceneTruth& truth, const SceneRun& run,
                          const SceneEvalOptions& options);

// Kept beside run.json, since evaluation takes seconds. stamp: tells by what it was made.
void WriteFigures(const std::filesystem::path& file, const RunFigures& figures,
                  std::string_view stamp);
// nullopt if there is none, or one made by something else.
std::optional<RunFigures> ReadFigures(const std::filesystem::path& file, std::string_view stamp);

}  // namespace cslam
