// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cmd_eval_scene.h"

#include "cslam/scene_eval/scene_report.h"
#include "cslam/scene_eval/scene_run.h"
#include "cslam/scene_eval/scene_truth.h"
#include "cslam/semantics/coco.h"
#include "cslam/util/atomic_file.h"
#include "cslam/util/check.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cli_common.h"
#include "exit_codes.h"

namespace cslam {
namespace {

struct SceneArguments {
  std::string truth;
  std::string run;
  double distance_m = SceneEvalOptions().max_distance_m;
  std::vector<std::string> classes;
  std::string json_file;
  std::optional<double> fail_below;
  std::string earlier;  // empty: none
};

std::set<int> ParseClasses(const std::vector<std::string>& names) {
  std::set<int> classes;
  for (const std::string& name : names) {
    const std::optional<int> class_id = FindCocoClass(name);
    if (!class_id)
      throw Error("no COCO class '{}'; examples: chair, tv, \"teddy bear\" (or teddy_bear)", name);
    classes.insert(*class_id);
  }
  return classes;
}

SceneRun ReadRun(const SceneArguments& arguments, const SceneTruth& truth) {
  SceneRun run = ReadSceneRun(arguments.run, truth.trajectory);
  if (!arguments.earlier.empty()) run.earlier = ReadSessionTime(arguments.earlier);
  return run;
}

template <typename Report>
void Print(const Report& report, const SceneTruth& truth, const SceneRun& run,
           const SceneArguments& arguments, bool json) {
  if (json && arguments.json_file.empty()) {
    fmt::print("{}", FormatJson(report, truth, run));
    return;
  }
  if (json) WriteFileAtomically(arguments.json_file, FormatJson(report, truth, run));
  fmt::print("{}", FormatReport(report, truth, run));
}

int JudgeBar(const DetectionScore& score, const SceneArguments& arguments) {
  if (!arguments.fail_below || score.F1().value_or(1.0) >= *arguments.fail_below) return kExitOk;
  fmt::print(stderr, "bar missed: F1 {:.3f} is below {:g}\n", *score.F1(), *arguments.fail_below);
  return kExitBarMissed;
}

int RunObjects(const SceneArguments& arguments, bool json) {
  const SceneEvalOptions options{.max_distance_m = arguments.distance_m,
                                 .classes = ParseClasses(arguments.classes)};
  const SceneTruth truth = ReadSceneTruth(arguments.truth);
  const SceneRun run = ReadRun(arguments, truth);
  const ObjectReport report = MakeObjectReport(truth, run, options);
  Print(report, truth, run, arguments, json);
  return JudgeBar(report.objects.all, arguments);
}

int RunChanges(const SceneArguments& arguments, bool json) {
  const SceneEvalOptions options{.max_distance_m = arguments.distance_m,
                                 .classes = ParseClasses(arguments.classes)};
  const SceneTruth truth = ReadSceneTruth(arguments.truth);
  const SceneRun run = ReadRun(arguments, truth);
  const ChangeReport report = MakeChangeReport(truth, run, options);
  Print(report, truth, run, arguments, json);
  return JudgeBar(report.changes.all, arguments);
}

// Refuses numbers that are not finite, not above low or above high.
CLI::Validator Within(double low, double high, const std::string& what) {
  return CLI::Validator(
      [=](const std::string& text) -> std::string {
        double value = 0.0;
        const bool is_good = CLI::detail::lexical_cast(text, value) && std::isfinite(value) &&
                             value > low && value <= high;
        return is_good ? "" : "'" + text + "' is not " + what;
      },
      "");
}

void AddArguments(CLI::App& app, SceneArguments& arguments) {
  app.add_option("TRUTH", arguments.truth, "Folder of the sequence, as 'dataset render' wrote it")
      ->required();
  app.add_option("RUN", arguments.run, "Folder that 'run' wrote")->required();
  app.add_option("--distance", arguments.distance_m, "Things match within this distance")
      ->type_name("METRES")
      ->check(Within(0.0, 100.0, "a distance above 0 m, at most 100 m"))
      ->capture_default_str();
  app.add_option("--classes", arguments.classes,
                 "COCO classes, with commas between; otherwise all of the truth but people")
      ->type_name("NAME,...")
      ->delimiter(',');
  app.add_option("--earlier", arguments.earlier,
                 "Run folder of the session whose map RUN went on with, on the same sequence")
      ->type_name("FOLDER");
  app.add_option("--json", arguments.json_file, "JSON instead of the table, or in FILE beside it")
      ->type_name("[FILE]")
      ->expected(0, 1);
  app.add_option("--fail-below", arguments.fail_below, "Exit with 3 if F1 over all is lower")
      ->type_name("F1")
      ->check(Within(-1e-9, 1.0, "a number from 0 to 1"));
}

}  // namespace

void AddSceneEvalCommands(CLI::App& eval, int& exit_code) {
  const auto objects = std::make_shared<SceneArguments>();
  CLI::App* const objects_app = eval.add_subcommand(
      "objects", "Objects in the map at the end of a run, ghosts, share of active points");
  AddArguments(*objects_app, *objects);
  AddExamples(*objects_app, {"eval objects data/onechair runs/onechair",
                             "eval objects data/onechair runs/onechair --classes chair,tv --json",
                             "eval objects data/onechair runs/onechair --fail-below 0.9"});
  objects_app->callback(
      [=, &exit_code] { exit_code = RunObjects(*objects, objects_app->count("--json") > 0); });

  const auto changes = std::make_shared<SceneArguments>();
  CLI::App* const changes_app =
      eval.add_subcommand("changes", "Changes that a run reports, their delays, and false loops");
  AddArguments(*changes_app, *changes);
  AddExamples(*changes_app, {"eval changes data/onechair runs/onechair",
                             "eval changes data/onechair runs/onechair --json changes_eval.json"});
  changes_app->callback(
      [=, &exit_code] { exit_code = RunChanges(*changes, changes_app->count("--json") > 0); });
}

}  // namespace cslam
