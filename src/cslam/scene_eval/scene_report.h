// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/scene_eval/change_eval.h"
#include "cslam/scene_eval/loop_eval.h"
#include "cslam/scene_eval/map_hygiene.h"
#include "cslam/scene_eval/object_eval.h"
#include "cslam/scene_eval/scene_run.h"

#include <optional>
#include <string>
#include <string_view>

namespace cslam {

// All that `eval objects` tells of a run.
struct ObjectReport {
  SceneEvalOptions options = {};
  ObjectEvaluation objects = {};
  std::optional<GhostCount> ghosts = {};  // absent without map.ply
  ActiveShare active = {};
};
ObjectReport MakeObjectReport(const SceneTruth& truth, const SceneRun& run,
                              const SceneEvalOptions& options = {});

// All that `eval changes` tells of a run.
struct ChangeReport {
  SceneEvalOptions options = {};
  ChangeEvaluation changes = {};
  std::optional<LoopEvaluation> loops = {};  // absent without loops.json
};
ChangeReport MakeChangeReport(const SceneTruth& truth, const SceneRun& run,
                              const SceneEvalOptions& options = {});

// Lined up for a terminal.
std::string FormatReport(const ObjectReport& report, const SceneTruth& truth, const SceneRun& run);
std::string FormatReport(const ChangeReport& report, const SceneTruth& truth, const SceneRun& run);

// One JSON object, indented, with a final newline; docs/evaluation.md describes the fields.
std::string FormatJson(const ObjectReport& report, const SceneTruth& truth, const SceneRun& run);
std::string FormatJson(const ChangeReport& report, const SceneTruth& truth, const SceneRun& run);

std::string_view NameOf(ObjectVerdict verdict);  // "matched", ...
std::string_view NameOf(ChangeVerdict verdict);

}  // namespace cslam
