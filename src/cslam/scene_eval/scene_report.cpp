// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/scene_eval/scene_report.h"

#include "cslam/semantics/coco.h"
#include "cslam/util/check.h"
#include "cslam/util/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace cslam {
namespace {

std::string ClassName(int class_id) {
  if (class_id < 0 || class_id >= kNumCocoClasses) return fmt::format("class {}", class_id);
  return std::string(CocoClassName(class_id));
}

std::string Number(const std::optional<double>& value, int decimals) {
  return value ? fmt::format("{:.{}f}", *value, decimals) : "-";
}

std::string Percent(const std::optional<double>& share) {
  return share ? fmt::format("{:.2f} %", 100.0 * *share) : "-";
}

std::string Place(const std::optional<Eigen::Vector3d>& place) {
  if (!place) return "-";
  return fmt::format("{:.2f} {:.2f} {:.2f}", place->x(), place->y(), place->z());
}

std::string FormatHead(const SceneTruth& truth, const SceneRun& run,
                       const SceneEvalOptions& options) {
  TextTable table;
  table.AddRow({"truth", truth.folder.string()});
  table.AddRow(
      {"run", fmt::format("{} ({:.1f} s to {:.1f} s of the sequence)", run.folder.string(),
                          truth.TimeOf(run.first_stamp()), truth.TimeOf(run.last_stamp()))});
  table.AddRow(
      {"aligned", fmt::format("{}, ATE {:.4f} m", Describe(run.alignment), run.ate_rmse_m)});
  table.AddRow({"match within", fmt::format("{:g} m, one to one", options.max_distance_m)});
  return table.Text();
}

std::vector<std::string> ScoreCells(const std::string& name, const DetectionScore& score) {
  return {name,
          fmt::format("{}", score.num_true),
          fmt::format("{}", score.num_reported),
          fmt::format("{}", score.num_matched),
          Number(score.Precision(), 3),
          Number(score.Recall(), 3),
          Number(score.F1(), 3)};
}

std::vector<std::string> ObjectCells(const std::string& name, const ObjectScore& score) {
  std::vector<std::string> cells = ScoreCells(name, score);
  const auto mean = [&](double value) {
    return score.num_matched > 0 ? fmt::format("{:.2f}", value) : "-";
  };
  cells.push_back(fmt::format("{}", score.num_duplicates));
  cells.push_back(mean(score.centroid_error_m));
  cells.push_back(mean(score.box_iou));
  cells.push_back(mean(score.axis_extent_iou));
  return cells;
}

std::vector<TextColumn> ScoreColumns(const std::string& what) {
  constexpr TextAlign kRight = TextAlign::kRight;
  return {{what},           {"true", kRight},   {"reported", kRight}, {"matched", kRight},
          {"prec", kRight}, {"recall", kRight}, {"F1", kRight}};
}

std::string FormatScores(const ObjectEvaluation& evaluation) {
  std::vector<TextColumn> columns = ScoreColumns("class");
  for (const char* title : {"duplicates", "centroid [m]", "box IoU", "extent IoU"})
    columns.push_back({title, TextAlign::kRight});
  TextTable table(columns);
  for (const auto& [class_id, score] : evaluation.classes)
    table.AddRow(ObjectCells(ClassName(class_id), score));
  table.AddRule();
  table.AddRow(ObjectCells("all", evaluation.all));
  return table.Text();
}

// What is not as it should be, a line each.
std::string FormatMistakes(const ObjectEvaluation& evaluation) {
  std::string text;
  for (const TruePlace& place : evaluation.places) {
    if (!place.is_required || IsFound(evaluation, place)) continue;
    text += fmt::format("missed: {} '{}' at {}\n", ClassName(place.class_id), place.name,
                        Place(place.box.T_world_box.translation));
  }
  for (const JudgedObject& object : evaluation.objects) {
    if (object.verdict != ObjectVerdict::kFalse && object.verdict != ObjectVerdict::kDuplicate)
      continue;
    text += fmt::format(
        "{}: {} {} at {}{}\n", NameOf(object.verdict), ClassName(object.found.report.class_id),
        object.found.report.id, Place(object.found.centroid),
        object.confused_with ? fmt::format(", where a {} is", ClassName(*object.confused_with))
                             : "");
  }
  const auto num_not_judged =
      std::count_if(evaluation.objects.begin(), evaluation.objects.end(),
                    [](const auto& o) { return o.verdict == ObjectVerdict::kNotJudged; });
  if (num_not_judged > 0)
    text += fmt::format("not judged: {} where the camera could not know better\n", num_not_judged);
  if (evaluation.num_other_classes > 0)
    text += fmt::format("not judged: {} of other classes\n", evaluation.num_other_classes);
  return text;
}

std::string FormatHygiene(const ObjectReport& report) {
  std::string text;
  if (report.ghosts) {
    text += fmt::format("ghosts: {} of {} active points ({}), {} former places seen again\n",
                        report.ghosts->ghosts.size(), report.ghosts->num_points,
                        Percent(report.ghosts->Share()), report.ghosts->num_former_places);
  }
  text += fmt::format("active: {} of {} points of present, settled objects ({})\n",
                      report.active.num_active, report.active.num_points,
                      Percent(report.active.Share()));
  return text;
}

std::string FormatKinds(const ChangeEvaluation& evaluation) {
  std::vector<TextColumn> columns = ScoreColumns("kind");
  for (const char* title : {"partial", "early"})
    columns.push_back({title, TextAlign::kRight});
  TextTable table(columns);
  for (const auto& [kind, score] : evaluation.kinds) {
    int num_partial = 0;
    int num_early = 0;
    for (const JudgedChange& change : evaluation.changes) {
      if (change.truth.change.kind != kind) continue;
      num_partial += change.is_partial ? 1 : 0;
      num_early += change.is_early ? 1 : 0;
    }
    std::vector<std::string> cells = ScoreCells(std::string(NameOf(kind)), score);
    cells.push_back(fmt::format("{}", num_partial));
    cells.push_back(fmt::format("{}", num_early));
    table.AddRow(std::move(cells));
  }
  table.AddRule();
  std::vector<std::string> cells = ScoreCells("all", evaluation.all);
  cells.push_back(fmt::format("{}", evaluation.num_partial));
  cells.push_back(fmt::format("{}", evaluation.num_early));
  table.AddRow(std::move(cells));
  return table.Text();
}

std::string StateOf(const JudgedChange& change) {
  if (!change.truth.counts()) return "does not count: " + change.truth.why_not;
  if (change.report) return "matched";
  if (change.is_early) return "missed: told too early";
  return change.is_partial ? "missed: partial" : "missed";
}

std::string ClassesOf(int class_id, ChangeKind kind, int new_class_id) {
  if (kind != ChangeKind::kReplaced) return ClassName(class_id);
  return ClassName(class_id) + " > " + ClassName(new_class_id);
}

std::string FormatTrueChanges(const ChangeEvaluation& evaluation) {
  if (evaluation.changes.empty()) return "";
  constexpr TextAlign kRight = TextAlign::kRight;
  TextTable table({{"true change"},
                   {"class"},
                   {"at [s]", kRight},
                   {"old seen", kRight},
                   {"new seen", kRight},
                   {"told", kRight},
                   {"delay [s]", kRight},
                   {"result"}});
  for (const JudgedChange& change : evaluation.changes) {
    const TrueChange& truth = change.truth.change;
    const std::string told_s =
        change.report ? fmt::format("{:.1f}", evaluation.reports[*change.report].time_s) : "-";
    table.AddRow(
        {std::string(NameOf(truth.kind)), ClassesOf(truth.class_id, truth.kind, truth.new_class_id),
         fmt::format("{:.1f}", truth.time_s), Number(change.truth.old_view_s, 1),
         Number(change.truth.new_view_s, 1), told_s, Number(change.delay_s, 1), StateOf(change)});
  }
  return table.Text();
}

// Reports that are no match, a line each.
std::string FormatOtherReports(const ChangeEvaluation& evaluation) {
  std::string text;
  for (const JudgedReport& report : evaluation.reports) {
    if (report.verdict == ChangeVerdict::kMatched) continue;
    const ReportedChange& told = report.report;
    text += fmt::format("{}: {} {}, object {}, from {} to {}, told at {:.1f} s\n",
                        NameOf(report.verdict), NameOf(told.kind),
                        ClassesOf(told.class_id, told.kind, told.new_class_id), told.object,
                        Place(told.from), Place(told.to), report.time_s);
  }
  if (evaluation.num_other_classes > 0)
    text += fmt::format("not judged: {} of other classes\n", evaluation.num_other_classes);
  return text;
}

std::string FormatLoops(const LoopEvaluation& loops) {
  std::string text = fmt::format("loops: {} accepted, {} of them false\n",
                                 loops.loops.size() + loops.num_without_truth, loops.num_false);
  for (const JudgedLoop& loop : loops.loops) {
    if (!loop.is_false) continue;
    text += fmt::format("false loop: {} to {} s, off by {:.2f} m, {:.1f} deg\n",
                        FormatStamp(loop.loop.query), FormatStamp(loop.loop.match), loop.error_m,
                        loop.error_deg);
  }
  return text;
}

}  // namespace

ObjectReport MakeObjectReport(const SceneTruth& truth, const SceneRun& run,
                              const SceneEvalOptions& options) {
  ObjectReport report{.options = WithKnownClasses(options, truth.objects)};
  report.objects = EvaluateObjects(truth, run, report.options);
  if (run.map_points)
    report.ghosts =
        CountGhosts(truth, run, {.clear_view = WithGapOf(options, truth, run).clear_view});
  report.active = ShareOfActivePoints(report.objects, run.last_stamp());
  return report;
}

ChangeReport MakeChangeReport(const SceneTruth& truth, const SceneRun& run,
                              const SceneEvalOptions& options) {
  ChangeReport report{.options = WithKnownClasses(options, truth.objects)};
  report.changes = EvaluateChanges(truth, run, report.options);
  if (run.loops) report.loops = EvaluateLoops(truth.trajectory, *run.loops);
  return report;
}

std::string FormatReport(const ObjectReport& report, const SceneTruth& truth, const SceneRun& run) {
  return FormatHead(truth, run, report.options) + "\n" + FormatScores(report.objects) + "\n" +
         FormatMistakes(report.objects) + FormatHygiene(report);
}

std::string FormatReport(const ChangeReport& report, const SceneTruth& truth, const SceneRun& run) {
  const ChangeEvaluation& changes = report.changes;
  std::string text = FormatHead(truth, run, report.options) + "\n" + FormatKinds(changes) + "\n";
  text += FormatTrueChanges(changes) + FormatOtherReports(changes);
  text += fmt::format("delay: median {} s, at most {} s\n", Number(changes.median_delay_s, 1),
                      Number(changes.max_delay_s, 1));
  return text + (report.loops ? FormatLoops(*report.loops) : "");
}

std::string_view NameOf(ObjectVerdict verdict) {
  switch (verdict) {
    case ObjectVerdict::kMatched:
      return "matched";
    case ObjectVerdict::kDuplicate:
      return "duplicate";
    case ObjectVerdict::kFalse:
      return "false";
    case ObjectVerdict::kNotJudged:
      return "not judged";
  }
  throw InternalError("verdict", "no such verdict", std::source_location::current());
}

std::string_view NameOf(ChangeVerdict verdict) {
  switch (verdict) {
    case ChangeVerdict::kMatched:
      return "matched";
    case ChangeVerdict::kFalse:
      return "false";
    case ChangeVerdict::kEarly:
      return "early";
    case ChangeVerdict::kPart:
      return "part";
    case ChangeVerdict::kNotJudged:
      return "not judged";
  }
  throw InternalError("verdict", "no such verdict", std::source_location::current());
}

}  // namespace cslam
