// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cmd_eval.h"

#include "cslam/eval/report.h"
#include "cslam/eval/trajectory_plot.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/util/atomic_file.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli_common.h"
#include "cmd_eval_scene.h"
#include "exit_codes.h"

namespace cslam {
namespace {

// What both measures are told.
struct EvalArguments {
  std::string reference;
  std::string estimate;
  double max_dt_s = 0.02;
  bool interpolate = false;
  std::string json_file;
  std::optional<double> fail_above_m;
  std::string statistic = "rmse";
};

struct AteArguments {
  EvalArguments common;
  std::string align = "se3";
  bool no_align = false;
  bool scale = false;
  std::string plot_file;
};

struct RpeArguments {
  EvalArguments common;
  double delta = 1.0;
  std::string unit = "f";
  bool all_pairs = false;
};

// A trajectory and where it was found.
struct Source {
  std::string path;
  Trajectory trajectory;
};

// A folder stands for the first of these files that is in it.
Source ReadSource(const std::string& given, const std::vector<std::string>& file_names) {
  std::filesystem::path path = given;
  if (std::filesystem::is_directory(path)) {
    for (const std::string& name : file_names) {
      if (std::filesystem::exists(path / name)) {
        path /= name;
        fmt::print(stderr, "{}: using {}\n", given, name);
        break;
      }
    }
    if (std::filesystem::is_directory(path)) {
      throw Error("folder '{}' holds no trajectory; looked for {}", given,
                  fmt::join(file_names, ", "));
    }
  }
  return {path.string(), ReadTrajectory(path)};
}

PoseAssociationOptions AssociationOf(const EvalArguments& arguments) {
  PoseAssociationOptions options;
  options.window_s = arguments.max_dt_s;
  if (arguments.interpolate) options.mode = PoseAssociationMode::kInterpolate;
  return options;
}

TrajectoryAlignment AlignmentOf(const AteArguments& arguments) {
  if (arguments.no_align || arguments.align == "none") return TrajectoryAlignment::kNone;
  if (arguments.scale || arguments.align == "sim3") return TrajectoryAlignment::kSim3;
  if (arguments.align == "origin") return TrajectoryAlignment::kOrigin;
  return TrajectoryAlignment::kSe3;
}

DeltaUnit UnitOf(const std::string& name) {
  if (name == "s") return DeltaUnit::kSeconds;
  return name == "m" ? DeltaUnit::kMetres : DeltaUnit::kFrames;
}

void WarnIfFewMatched(const PoseAssociation& association) {
  constexpr double kFew = 0.9;
  if (association.EstimateShare() >= kFew) return;
  fmt::print(stderr,
             "warning: only {} of {} estimated poses have a reference; the rest is unmeasured\n",
             association.pairs.size(), association.num_estimate);
}

template <typename Result>
void PrintResult(const Result& result, const ReportNames& names, const EvalArguments& arguments,
                 bool json) {
  WarnIfFewMatched(result.association);
  if (json && arguments.json_file.empty()) {
    fmt::print("{}", FormatJson(result, names));
    return;
  }
  if (json) WriteFileAtomically(arguments.json_file, FormatJson(result, names));
  fmt::print("{}", FormatReport(result, names));
}

int JudgeBar(const ErrorStatistics& statistics_m, const EvalArguments& arguments) {
  if (!arguments.fail_above_m) return kExitOk;
  const Statistic statistic = ParseStatistic(arguments.statistic).value();
  const double value_m = ValueOf(statistics_m, statistic);
  if (value_m <= *arguments.fail_above_m) return kExitOk;
  fmt::print(stderr, "bar missed: {} {:.6f} m is above {:g} m\n", arguments.statistic, value_m,
             *arguments.fail_above_m);
  return kExitBarMissed;
}

// The folder of the reference names the sequence; a file alone names itself.
std::string PlotTitle(const std::string& reference_path) {
  const std::filesystem::path path = std::filesystem::absolute(reference_path);
  const bool is_dataset_file = path.filename().string().starts_with("groundtruth");
  return (is_dataset_file ? path.parent_path() : path).filename().string();
}

int RunAte(const AteArguments& arguments, bool json) {
  const Source reference =
      ReadSource(arguments.common.reference, {"groundtruth.txt", "trajectory.txt"});
  const Source estimate = ReadSource(arguments.common.estimate, {"trajectory.txt"});
  AteOptions options;
  options.association = AssociationOf(arguments.common);
  options.alignment = AlignmentOf(arguments);
  const AteResult result = EvaluateAte(reference.trajectory, estimate.trajectory, options);
  if (!arguments.plot_file.empty()) {
    WriteTrajectorySvg(arguments.plot_file, {.title = PlotTitle(reference.path),
                                             .estimate = estimate.trajectory,
                                             .reference = reference.trajectory,
                                             .ate = result});
    fmt::print(stderr, "plot: {}\n", arguments.plot_file);
  }
  PrintResult(result, {reference.path, estimate.path}, arguments.common, json);
  return JudgeBar(result.statistics_m, arguments.common);
}

int RunRpe(const RpeArguments& arguments, bool json) {
  // Relative motion must be that of the camera; some data sets track markers beside it.
  const Source reference = ReadSource(
      arguments.common.reference, {"groundtruth_camera.txt", "groundtruth.txt", "trajectory.txt"});
  const Source estimate = ReadSource(arguments.common.estimate, {"trajectory.txt"});
  RpeOptions options;
  options.association = AssociationOf(arguments.common);
  options.delta = arguments.delta;
  options.unit = UnitOf(arguments.unit);
  if (arguments.all_pairs) options.pairs = RpePairs::kAll;
  const RpeResult result = EvaluateRpe(reference.trajectory, estimate.trajectory, options);
  PrintResult(result, {reference.path, estimate.path}, arguments.common, json);
  return JudgeBar(result.translation_m, arguments.common);
}

// Refuses negative numbers and those that are none, such as nan.
CLI::Validator NotNegative() {
  return CLI::Validator(
      [](const std::string& text) -> std::string {
        double value = 0.0;
        if (CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value >= 0.0)
          return "";
        return "'" + text + "' is not a number of at least 0";
      },
      "");
}

void AddOutputArguments(CLI::App& app, EvalArguments& arguments) {
  app.add_option("--json", arguments.json_file, "JSON instead of the table, or in FILE beside it")
      ->type_name("[FILE]")
      ->expected(0, 1);
  app.add_option("--fail-above", arguments.fail_above_m,
                 "Exit with 3 if the translation error is larger")
      ->type_name("METRES")
      ->check(NotNegative());
  app.add_option("--statistic", arguments.statistic, "What --fail-above judges")
      ->type_name("NAME")
      ->check(CLI::IsMember({"rmse", "mean", "median", "max"}))
      ->capture_default_str();
}

void AddCommonArguments(CLI::App& app, EvalArguments& arguments) {
  app.add_option("REF", arguments.reference,
                 "True trajectory (TUM format), or a dataset folder with groundtruth.txt")
      ->required();
  app.add_option("EST", arguments.estimate,
                 "Estimated trajectory (TUM format), or a run folder with trajectory.txt")
      ->required();
  app.add_option("--max-dt", arguments.max_dt_s, "Poses match within this time")
      ->type_name("SECONDS")
      ->check(NotNegative())
      ->capture_default_str();
  app.add_flag("--interpolate", arguments.interpolate,
               "Interpolate the reference instead of taking its nearest pose");
  AddOutputArguments(app, arguments);
}

void AddAteCommand(CLI::App& eval, int& exit_code) {
  CLI::App* const app =
      eval.add_subcommand("ate", "Absolute trajectory error: distance between camera centres");
  const auto arguments = std::make_shared<AteArguments>();
  AddCommonArguments(*app, arguments->common);
  CLI::Option* const align =
      app->add_option("--align", arguments->align, "None, origin (first pose), rigid or with scale")
          ->type_name("MODE")
          ->check(CLI::IsMember({"none", "origin", "se3", "sim3"}))
          ->capture_default_str();
  CLI::Option* const no_align =
      app->add_flag("--no-align", arguments->no_align, "Same as --align none");
  CLI::Option* const scale = app->add_flag("-s,--scale", arguments->scale, "Same as --align sim3");
  no_align->excludes(align)->excludes(scale);
  scale->excludes(align);
  app->add_option("--plot", arguments->plot_file, "Draw both trajectories from above (SVG)")
      ->type_name("FILE");
  AddExamples(*app, {"eval ate data/tum_fr1_desk runs/desk",
                     "eval ate groundtruth.txt trajectory.txt --plot trajectory.svg",
                     "eval ate groundtruth.txt trajectory.txt --fail-above 0.018",
                     "eval ate groundtruth.txt trajectory.txt --align origin --json"});
  app->callback([=, &exit_code] { exit_code = RunAte(*arguments, app->count("--json") > 0); });
}

void AddRpeCommand(CLI::App& eval, int& exit_code) {
  CLI::App* const app =
      eval.add_subcommand("rpe", "Relative pose error: drift of the motion between two poses");
  const auto arguments = std::make_shared<RpeArguments>();
  AddCommonArguments(*app, arguments->common);
  app->add_option("--delta", arguments->delta, "How far apart the two poses are")
      ->type_name("NUMBER")
      ->check(NotNegative())
      ->capture_default_str();
  app->add_option("--delta-unit", arguments->unit,
                  "Matched poses (f), seconds or metres along the reference")
      ->type_name("UNIT")
      ->check(CLI::IsMember({"f", "s", "m"}))
      ->capture_default_str();
  app->add_flag("--all-pairs", arguments->all_pairs,
                "Begin at every pose instead of where the last pair ended");
  AddExamples(*app, {"eval rpe data/tum_fr1_desk runs/desk",
                     "eval rpe groundtruth.txt trajectory.txt --delta 1 --delta-unit s --all-pairs",
                     "eval rpe groundtruth.txt trajectory.txt --statistic max --fail-above 0.03"});
  app->callback([=, &exit_code] { exit_code = RunRpe(*arguments, app->count("--json") > 0); });
}

}  // namespace

CLI::App* AddEvalCommand(CLI::App& root, int& exit_code) {
  CLI::App* const app = root.add_subcommand("eval", "Compare what a run says with the truth");
  app->require_subcommand(1);
  AddAteCommand(*app, exit_code);
  AddRpeCommand(*app, exit_code);
  AddSceneEvalCommands(*app, exit_code);
  AddExamples(*app, {"eval ate data/tum_fr1_desk runs/desk",
                     "eval rpe groundtruth.txt trajectory.txt --delta 1 --delta-unit s"});
  return app;
}

}  // namespace cslam
