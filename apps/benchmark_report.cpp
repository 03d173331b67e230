// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark_report.h"

#include "cslam/benchmark/report_text.h"
#include "cslam/benchmark/top_view.h"
#include "cslam/eval/trajectory_plot.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/run/process_info.h"
#include "cslam/util/atomic_file.h"
#include "cslam/util/check.h"

#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <optional>

#include "interrupt.h"
#include "progress_bar.h"
#include "version.h"

namespace cslam {
namespace {

namespace fs = std::filesystem;

// By what figures.json was made.
std::string EvaluationStamp(const BenchmarkArguments& arguments) {
  std::string stamp = fmt::format("{} classes", GitCommit());
  for (const int class_id : arguments.classes)
    stamp += fmt::format(" {}", class_id);
  return stamp;
}

SceneEvalOptions EvalOptions(const BenchmarkArguments& arguments) {
  SceneEvalOptions options;
  options.classes = arguments.classes;
  return options;
}

// The truth of one rendering at a time: the runs of each stand together.
class Truths {
 public:
  const SceneTruth& Of(const PlannedData& data) {
    if (!truth_ || folder_ != data.folder) {
      truth_ = std::make_unique<SceneTruth>(ReadSceneTruth(data.folder));
      folder_ = data.folder;
    }
    return *truth_;
  }

 private:
  fs::path folder_;
  std::unique_ptr<SceneTruth> truth_;
};

std::string LastLine(const fs::path& log) {
  std::ifstream file(log);
  std::string line;
  std::string last;
  while (std::getline(file, line)) {
    if (!line.empty()) last = line;
  }
  return last.empty() ? "it has no results" : last;
}

FinishedRun Judge(const PlannedRun& run, const PlannedData& data, Truths& truths,
                  const BenchmarkArguments& arguments) {
  FinishedRun finished{run, std::nullopt, ""};
  const fs::path file = run.folder / "figures.json";
  const std::string stamp = EvaluationStamp(arguments);
  if (!fs::exists(run.folder / "run.json")) {
    finished.problem = LastLine(run.folder.string() + ".log");
    return finished;
  }
  try {
    finished.figures = ReadFigures(file, stamp);
    if (finished.figures) return finished;
    const SceneTruth& truth = truths.Of(data);
    const SceneRun scene = ReadSceneRun(run.folder, truth.trajectory);
    finished.figures = EvaluateRun(truth, scene, EvalOptions(arguments)).figures;
    WriteFigures(file, *finished.figures, stamp);
  } catch (const Error& error) {
    finished.problem = error.what();
  }
  return finished;
}

// The file of another system for a rendering; the plain name stands for the first seed.
fs::path OtherFile(const fs::path& folder, const PlannedData& data,
                   const BenchmarkRequest& request) {
  const fs::path exact = folder / (data.folder.filename().string() + ".txt");
  if (fs::exists(exact) || data.seed != request.first_seed) return exact;
  return folder / (data.sequence + ".txt");
}

std::vector<OtherTrajectory> JudgeOthers(const BenchmarkArguments& arguments,
                                         const BenchmarkPlan& plan) {
  std::vector<OtherTrajectory> others;
  for (const auto& [label, folder] : arguments.others) {
    for (const PlannedData& data : plan.data) {
      const fs::path file = OtherFile(folder, data, arguments.request);
      if (!fs::exists(file)) continue;
      OtherTrajectory other{label, data.sequence, data.seed, std::nullopt, ""};
      try {
        const Trajectory reference = ReadTrajectory(data.folder / "groundtruth.txt");
        other.ate_m = EvaluateAte(reference, ReadTrajectory(file)).statistics_m.rmse;
      } catch (const Error& error) {
        other.problem = error.what();
      }
      others.push_back(std::move(other));
    }
  }
  return others;
}

std::string_view NameOf(BenchmarkDetector detector) {
  switch (detector) {
    case BenchmarkDetector::kNone:
      return "none";
    case BenchmarkDetector::kNetwork:
      return "network";
    case BenchmarkDetector::kPerfect:
      break;
  }
  return "perfect boxes (detections.json of the rendering)";
}

void AddFacts(const BenchmarkArguments& arguments, BenchmarkResult& result) {
  const HostInfo host = DescribeHost();
  auto& facts = result.facts;
  facts.emplace_back("program", ProgramName());
  facts.emplace_back("host", fmt::format("{}, {} cores", host.cpu, host.num_cpus));
  facts.emplace_back("detector", std::string(NameOf(arguments.detector)));
  if (!arguments.model.empty()) facts.emplace_back("model", arguments.model);
  facts.emplace_back("runs", arguments.request.is_short
                                 ? fmt::format("threaded, --rate {}", arguments.rate)
                                 : std::string("inline (--deterministic)"));
  std::string options;
  for (const std::string& word : arguments.run_options)
    options += (options.empty() ? "" : " ") + word;
  if (!options.empty()) facts.emplace_back("options", options);
}

RunDrawing Draw(const FinishedRun& run, const PlannedData& data, Truths& truths,
                const BenchmarkArguments& arguments) {
  const SceneTruth& truth = truths.Of(data);
  const SceneRun scene = ReadSceneRun(run.run.folder, truth.trajectory);
  const RunEvaluation evaluation = EvaluateRun(truth, scene, EvalOptions(arguments));
  const std::string title =
      fmt::format("{}, objects {}", data.folder.filename().string(), NameOf(run.run.layer));
  TrajectoryPlot plot{
      .title = title, .estimate = scene.trajectory, .reference = truth.trajectory, .ate = {}};
  if (scene.alignment == TrajectoryAlignment::kSe3) {
    plot.ate = EvaluateAte(truth.trajectory, scene.trajectory);
  }
  return {.title = title,
          .top_view = FormatTopViewSvg(MakeTopView(title, truth, scene, evaluation)),
          .trajectory = FormatTrajectorySvg(plot)};
}

}  // namespace

BenchmarkResult JudgeRuns(const BenchmarkArguments& arguments, const BenchmarkPlan& plan) {
  BenchmarkResult result;
  result.request = arguments.request;
  result.plan = plan;
  Truths truths;
  ProgressBar bar("judging runs", static_cast<int>(plan.runs.size()));
  for (const PlannedRun& run : plan.runs) {
    if (InterruptRequested()) return result;
    result.runs.push_back(Judge(run, plan.data[run.data], truths, arguments));
    bar.Update(static_cast<int>(result.runs.size()));
  }
  result.others = JudgeOthers(arguments, plan);
  AddFacts(arguments, result);
  return result;
}

void WriteReports(const BenchmarkArguments& arguments, const BenchmarkResult& result) {
  const fs::path& folder = arguments.request.folder;
  WriteFileAtomically(folder / "report.md", FormatMarkdown(result));
  WriteFileAtomically(folder / "report.json", FormatJson(result));
  std::vector<RunDrawing> drawings;
  Truths truths;
  for (const std::string& sequence : result.plan.Sequences()) {
    for (const ObjectLayer layer : result.request.layers) {
      const FinishedRun* const run = result.Typical(sequence, layer);
      if (run == nullptr || InterruptRequested()) continue;
      drawings.push_back(Draw(*run, result.plan.data[run->run.data], truths, arguments));
    }
  }
  WriteFileAtomically(folder / "report.html", FormatHtml(result, drawings));
}

}  // namespace cslam
