// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/benchmark/run_figures.h"

#include "cslam/io/json_reader.h"
#include "cslam/util/atomic_file.h"
#include "cslam/util/check.h"

#include <fmt/format.h>

#include <array>
#include <string>

namespace cslam {
namespace {

using F = RunFigures;
constexpr std::array kFigures = {
    FigureInfo{"ate_m", "ATE mm", &F::ate_m, 1000.0, 1},
    FigureInfo{"tracked_share", "tracked %", &F::tracked_share, 100.0, 1},
    FigureInfo{"loops", "loops", &F::loops, 1.0, 0},
    FigureInfo{"false_loops", "false loops", &F::false_loops, 1.0, 0},
    FigureInfo{"object_f1", "objects F1", &F::object_f1, 1.0, 2},
    FigureInfo{"object_precision", "precision", &F::object_precision, 1.0, 2},
    FigureInfo{"object_recall", "recall", &F::object_recall, 1.0, 2},
    FigureInfo{"change_f1", "changes F1", &F::change_f1, 1.0, 2},
    FigureInfo{"change_precision", "precision", &F::change_precision, 1.0, 2},
    FigureInfo{"change_recall", "recall", &F::change_recall, 1.0, 2},
    FigureInfo{"objects_true", "true", &F::objects_true, 1.0, 0},
    FigureInfo{"objects_reported", "reported", &F::objects_reported, 1.0, 0},
    FigureInfo{"objects_matched", "matched", &F::objects_matched, 1.0, 0},
    FigureInfo{"changes_true", "true", &F::changes_true, 1.0, 0},
    FigureInfo{"changes_reported", "reported", &F::changes_reported, 1.0, 0},
    FigureInfo{"changes_matched", "matched", &F::changes_matched, 1.0, 0},
    FigureInfo{"ghost_share", "ghosts %", &F::ghost_share, 100.0, 2},
    FigureInfo{"active_share", "active %", &F::active_share, 100.0, 1},
    FigureInfo{"delay_s", "delay s", &F::delay_s, 1.0, 1},
    FigureInfo{"max_delay_s", "longest s", &F::max_delay_s, 1.0, 1},
    FigureInfo{"tracking_ms", "tracking ms", &F::tracking_ms, 1.0, 1},
    FigureInfo{"mapping_ms", "mapping ms", &F::mapping_ms, 1.0, 1},
    FigureInfo{"memory_mb", "memory MB", &F::memory_mb, 1.0, 0},
    FigureInfo{"run_s", "run s", &F::run_s, 1.0, 0},
};

std::optional<double> NumberAt(const JsonValue& value, std::initializer_list<const char*> path) {
  JsonValue at = value;
  for (const char* key : path) {
    if (!at.Has(key)) return std::nullopt;
    at = at.At(key);
  }
  if (at.IsNull()) return std::nullopt;
  return at.Number();
}

}  // namespace

std::span<const FigureInfo> AllFigures() {
  return kFigures;
}

const FigureInfo& FigureOf(std::string_view key) {
  for (const FigureInfo& info : kFigures) {
    if (info.key == key) return info;
  }
  throw InternalError("a known figure", std::string(key), std::source_location::current());
}

RunFigures ReadRunFigures(const std::filesystem::path& run_folder) {
  const JsonFile json(run_folder / "run.json");
  const JsonValue root = json.root();
  RunFigures figures;
  figures.ate_m = NumberAt(root, {"accuracy", "trajectory", "ate_m", "rmse"});
  figures.tracked_share = NumberAt(root, {"frames", "tracked_percent"});
  if (figures.tracked_share) *figures.tracked_share *= 0.01;
  figures.tracking_ms = NumberAt(root, {"stages", "tracking", "wall", "median_ms"});
  figures.mapping_ms = NumberAt(root, {"stages", "mapping", "wall", "median_ms"});
  figures.memory_mb = NumberAt(root, {"cost", "peak_memory_bytes"});
  if (figures.memory_mb) *figures.memory_mb *= 1e-6;
  figures.run_s = NumberAt(root, {"cost", "wall_s"});
  return figures;
}

RunEvaluation EvaluateRun(const SceneTruth& truth, const SceneRun& run,
                          const SceneEvalOptions& options) {
  RunEvaluation evaluation;
  RunFigures& f = evaluation.figures;
  f = ReadRunFigures(run.folder);
  if (run.objects) {
    evaluation.objects = MakeObjectReport(truth, run, options);
    const ObjectReport& objects = evaluation.objects;
    f.object_f1 = objects.objects.all.F1();
    f.object_precision = objects.objects.all.Precision();
    f.object_recall = objects.objects.all.Recall();
    f.objects_true = objects.objects.all.num_true;
    f.objects_reported = objects.objects.all.num_reported;
    f.objects_matched = objects.objects.all.num_matched;
    f.active_share = objects.active.Share();
    if (objects.ghosts) f.ghost_share = objects.ghosts->Share();
  } else if (run.map_points) {
    evaluation.objects.ghosts = CountGhosts(truth, run);
    f.ghost_share = evaluation.objects.ghosts->Share();
  }
  if (run.changes) {
    evaluation.changes = MakeChangeReport(truth, run, options);
    const ChangeEvaluation& changes = evaluation.changes.changes;
    f.change_f1 = changes.all.F1();
    f.change_precision = changes.all.Precision();
    f.change_recall = changes.all.Recall();
    f.changes_true = changes.all.num_true;
    f.changes_reported = changes.all.num_reported;
    f.changes_matched = changes.all.num_matched;
    f.delay_s = changes.median_delay_s;
    f.max_delay_s = changes.max_delay_s;
  }
  if (run.loops) {
    const LoopEvaluation loops = EvaluateLoops(truth.trajectory, *run.loops);
    f.loops = static_cast<double>(run.loops->size());
    f.false_loops = loops.num_false;
  }
  return evaluation;
}

void WriteFigures(const std::filesystem::path& file, const RunFigures& figures,
                  std::string_view stamp) {
  std::string text = fmt::format("{{\n  \"made_by\": {}", JsonQuoted(stamp));
  for (const FigureInfo& info : kFigures) {
    const std::optional<double>& value = figures.*info.value;
    text += fmt::format(",\n  \"{}\": {}", info.key,
                        value ? fmt::format("{:.9g}", *value) : std::string("null"));
  }
  WriteFileAtomically(file, text + "\n}\n");
}

std::optional<RunFigures> ReadFigures(const std::filesystem::path& file, std::string_view stamp) {
  if (!std::filesystem::exists(file)) return std::nullopt;
  const JsonFile json(file);
  if (!json.root().Has("made_by") || json.root().At("made_by").Text() != stamp) {
    return std::nullopt;
  }
  RunFigures figures;
  for (const FigureInfo& info : kFigures)
    figures.*info.value = NumberAt(json.root(), {std::string(info.key).c_str()});
  return figures;
}

}  // namespace cslam
