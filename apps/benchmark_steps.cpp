// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark_steps.h"

#include "cslam/benchmark/tables.h"
#include "cslam/util/check.h"
#include "cslam/util/stopwatch.h"
#include "cslam/util/text_table.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <system_error>

#include "benchmark_report.h"
#include "child_process.h"
#include "disk_space.h"
#include "exit_codes.h"
#include "interrupt.h"
#include "version.h"

namespace cslam {
namespace {

namespace fs = std::filesystem;

// For the first guess only: measured on two cores of a small server, 640x480; the time told while
// it works is that of the runs done.
constexpr double kFrameSeconds = 0.02;
constexpr double kNetworkFrameSeconds = 0.025;
constexpr double kJudgeSeconds = 5.0;
constexpr double kRunBytes = 5e6;

// This program, even if its file has been replaced since.
constexpr const char* kThisProgram = "/proc/self/exe";

std::string TimeText(double seconds) {
  const int minutes = static_cast<int>(std::ceil(seconds / 60.0));
  if (minutes < 60) return fmt::format("{} min", minutes);
  return fmt::format("{} h {:02d} min", minutes / 60, minutes % 60);
}

RenderArguments RenderOf(const BenchmarkArguments& arguments, const PlannedData& data) {
  RenderArguments render = arguments.render;
  render.names = {data.sequence};
  render.folder = data.folder;
  render.request.seed = data.seed;
  render.request.is_short = arguments.request.is_short;
  render.existing = ExistingFolder::kResume;
  return render;
}

std::string_view NameOf(Look look) {
  switch (look) {
    case Look::kAuto:
      return "";
    case Look::kPackages:
      return "packages";
    case Look::kProcedural:
      return "procedural";
  }
  throw InternalError("look", "no such look", std::source_location::current());
}

RenderingState StateOf(const RenderArguments& render, const PlannedData& data) {
  const RenderingState state = StateOf(data, render.request, NameOf(render.look), ProgramName());
  if (state == RenderingState::kOutdated && fs::is_symlink(data.folder)) {
    throw Error(
        "'{}' is a link to a rendering that another version of the program began; remove the link, "
        "or render there anew ('changing-slam dataset render --force')",
        data.folder.string());
  }
  return state;
}

// Beside the rendering if that must not be touched yet.
RenderEstimate Estimate(RenderArguments render, RenderingState state) {
  if (state != RenderingState::kOutdated) return EstimateRendering(render);
  render.folder += ".estimate";
  render.existing = ExistingFolder::kReplace;
  const RenderEstimate estimate = EstimateRendering(render);
  fs::remove_all(render.folder);
  return estimate;
}

std::vector<std::string> RunWords(const BenchmarkArguments& arguments, const PlannedRun& run,
                                  const PlannedData& data) {
  std::vector<std::string> words{"run", data.folder.string(), "--out", run.folder.string()};
  const auto add = [&](std::initializer_list<std::string> more) {
    words.insert(words.end(), more.begin(), more.end());
  };
  if (arguments.request.is_short) {
    add({"--rate", arguments.rate});
  } else {
    add({"--deterministic"});
  }
  switch (arguments.detector) {
    case BenchmarkDetector::kNone:
      add({"--detector", "none"});
      break;
    case BenchmarkDetector::kNetwork:
      add({"--detector", "dnn"});
      break;
    case BenchmarkDetector::kPerfect:
      add({"--detections", (data.folder / "detections.json").string()});
      break;
  }
  if (!arguments.model.empty()) add({"--model", arguments.model});
  words.insert(words.end(), arguments.run_options.begin(), arguments.run_options.end());
  // People and what moves are left out all the same.
  if (run.layer == ObjectLayer::kOff) {
    add({"--set", "mapping.objects.enabled=false"});
    add({"--set", "tracking.objects.label_movable=false"});
  }
  return words;
}

bool IsDone(const BenchmarkArguments& arguments, const PlannedRun& run, const PlannedData& data) {
  return IsRunDone(run.folder, GitCommit(), RunWords(arguments, run, data));
}

// What is left to do, and what that will take.
struct Outlook {
  int renderings = 0;
  int replaced = 0;  // of these, what another version began
  int runs = 0;
  double render_s = 0.0;
  double run_s = 0.0;
  double bytes = 0.0;
};

// Seeds of one sequence take about the same: one of them is tried.
Outlook LookAhead(const BenchmarkArguments& arguments, const BenchmarkPlan& plan) {
  Outlook outlook;
  std::map<std::string, RenderEstimate> estimates;
  for (const PlannedData& data : plan.data) {
    const RenderArguments render = RenderOf(arguments, data);
    const RenderingState state = StateOf(render, data);
    if (state == RenderingState::kComplete || InterruptRequested()) continue;
    ++outlook.renderings;
    outlook.replaced += state == RenderingState::kOutdated ? 1 : 0;
    if (!estimates.contains(data.sequence)) {
      fmt::print(stderr, "a few frames of '{}', to know how long it will take\n", data.sequence);
      estimates[data.sequence] = Estimate(render, state);
    }
    const RenderEstimate& estimate = estimates.at(data.sequence);
    outlook.render_s += estimate.seconds;
    outlook.bytes += estimate.bytes;
  }
  for (const PlannedRun& run : plan.runs) {
    const PlannedData& data = plan.data[run.data];
    if (IsDone(arguments, run, data)) continue;
    ++outlook.runs;
    const SequenceEntry entry = FindSequence(data.sequence);
    const RenderArguments render = RenderOf(arguments, data);
    const bool has_network = arguments.detector == BenchmarkDetector::kNetwork;
    const double frame_s = kFrameSeconds + (has_network ? kNetworkFrameSeconds : 0.0);
    outlook.run_s += kJudgeSeconds + frame_s * CountFrames(entry, render.request);
    outlook.bytes += kRunBytes;
  }
  return outlook;
}

void Announce(const Outlook& outlook, const BenchmarkPlan& plan, const fs::path& folder) {
  fmt::print(
      stderr,
      "{} of {} renderings to do (about {}) and {} of {} runs (about {}), about {} in '{}'\n",
      outlook.renderings, plan.data.size(), TimeText(outlook.render_s), outlook.runs,
      plan.runs.size(), TimeText(outlook.run_s), FormatBytes(outlook.bytes), folder.string());
  if (outlook.replaced > 0) {
    fmt::print(stderr, "{} of the renderings replace what another version of the program began\n",
               outlook.replaced);
  }
}

// False: the user ended it.
bool RenderAll(const BenchmarkArguments& arguments, const BenchmarkPlan& plan) {
  for (const PlannedData& data : plan.data) {
    if (InterruptRequested()) return false;
    RenderArguments render = RenderOf(arguments, data);
    const RenderingState state = StateOf(render, data);
    if (state == RenderingState::kComplete) continue;
    if (state == RenderingState::kOutdated) render.existing = ExistingFolder::kReplace;
    fs::create_directories(data.folder.parent_path());
    if (RenderSequences(render) != kExitOk) return false;
  }
  return true;
}

void RunOne(const BenchmarkArguments& arguments, const PlannedRun& run, const PlannedData& data) {
  std::error_code ignored;
  fs::remove(run.folder / "run.json", ignored);
  fs::remove(run.folder / "figures.json", ignored);
  std::vector<std::string> command = RunWords(arguments, run, data);
  command.insert(command.begin(), kThisProgram);
  const int exit_code = RunChildProcess(
      command, {.log = run.folder.string() + ".log", .is_interrupted = InterruptRequested});
  if (exit_code != kExitOk && !InterruptRequested()) {
    fmt::print(stderr, "warning: run '{}' ended with exit code {}; see '{}.log'\n",
               run.folder.filename().string(), exit_code, run.folder.string());
  }
}

// False: the user ended it.
bool RunAll(const BenchmarkArguments& arguments, const BenchmarkPlan& plan) {
  fs::create_directories(arguments.request.folder / "runs");
  std::vector<const PlannedRun*> left;
  for (const PlannedRun& run : plan.runs) {
    if (!IsDone(arguments, run, plan.data[run.data])) left.push_back(&run);
  }
  const Stopwatch watch;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (InterruptRequested()) return false;
    const double done_s = 1e-3 * watch.ElapsedMs();
    const double left_s = done_s / static_cast<double>(std::max<std::size_t>(i, 1)) *
                          static_cast<double>(left.size() - i);
    fmt::print(stderr, "run {} of {}: {}{}\n", i + 1, left.size(),
               left[i]->folder.filename().string(),
               i == 0 ? "" : fmt::format(", {} left", TimeText(left_s)));
    RunOne(arguments, *left[i], plan.data[left[i]->data]);
  }
  return !InterruptRequested();
}

void CheckOthers(const BenchmarkArguments& arguments) {
  for (const auto& [label, folder] : arguments.others) {
    if (!fs::is_directory(folder)) {
      throw Error("--trajectories {}: there is no folder '{}'", label, folder.string());
    }
  }
}

int SayInterrupted() {
  fmt::print(stderr,
             "interrupted; what is done is kept, and the same command goes on from there\n");
  return kExitInterrupted;
}

void PrintTables(const BenchmarkResult& result) {
  for (const ReportTable& table : MakeTables(result)) {
    std::vector<TextColumn> columns;
    for (const std::string& column : table.columns)
      columns.push_back({column, columns.empty() ? TextAlign::kLeft : TextAlign::kRight});
    TextTable text(std::move(columns));
    for (const std::vector<std::string>& row : table.rows)
      text.AddRow(row);
    fmt::print("{}\n{}\n", table.title, text.Text(2));
  }
}

}  // namespace

int RunBenchmark(const BenchmarkArguments& arguments) {
  CatchInterrupts();
  CheckOthers(arguments);
  const fs::path& folder = arguments.request.folder;
  const BenchmarkPlan plan = MakePlan(arguments.request);
  const Outlook outlook = LookAhead(arguments, plan);
  if (InterruptRequested()) return SayInterrupted();
  Announce(outlook, plan, folder);
  CheckFreeSpace(folder, outlook.bytes);
  if (!arguments.is_confirmed && outlook.renderings + outlook.runs > 0) {
    fmt::print(stderr, "nothing is done yet: add --yes to do it\n");
    return kExitOk;
  }
  if (!RenderAll(arguments, plan) || !RunAll(arguments, plan)) return SayInterrupted();
  const BenchmarkResult result = JudgeRuns(arguments, plan);
  if (InterruptRequested()) return SayInterrupted();
  WriteReports(arguments, result);
  PrintTables(result);
  fmt::print(stderr, "report: '{}' and .md, .json beside it\n", (folder / "report.html").string());
  return result.num_failed() == 0 ? kExitOk : kExitRuntimeError;
}

}  // namespace cslam
