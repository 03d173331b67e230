// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cmd_run.h"

#include "cslam/eval/ate.h"
#include "cslam/eval/rpe.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/run/sequence_player.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <map>
#include <memory>

#include "cli_common.h"
#include "exit_codes.h"
#include "interrupt.h"

namespace cslam {
namespace {

struct RunCommand {
  std::filesystem::path sequence;
  ConfigArguments config;
  bool deterministic = false;
  std::string rate = "max";
  std::size_t from = 0;
  std::size_t frames = 0;
};

class Collect : public OutputSink {
 public:
  void OnFrame(const TrackingResult& r) override {
    for (auto& t : r.times)
      times[t.stage].push_back(t.ms);
    if (r.state != TrackingState::kTracking)
      fmt::print(stderr, "{} {} {}\n", r.frame.value(), ToString(r.state), r.reason);
    reasons[ToString(r.keyframe_reason)]++;
    inliers += r.num_inliers;
    matches += r.num_map_matches;
    kps += r.num_keypoints;
    ++n;
    if (getenv("CSLAM_DUMP"))
      fmt::print(stderr, "{} inl {} match {} kp {} {} kf {}\n", r.frame.value(), r.num_inliers,
                 r.num_map_matches, r.num_keypoints, ToString(r.keyframe_reason),
                 r.reference.value());
  }
  void OnMap(const MapUpdate& u) override {
    for (auto& t : u.times)
      times[t.stage].push_back(t.ms);
    stopped += u.ba_was_stopped;
    iterations += u.ba_iterations;
    culled += u.keyframes_culled;
  }
  std::map<std::string, std::vector<double>> times;
  std::map<std::string, int> reasons;
  double inliers = 0, matches = 0, kps = 0, n = 0;
  int stopped = 0, iterations = 0, culled = 0;
};

int Run(const RunCommand& c) {
  const SlamOptions options = LoadSlamOptions(c.config);
  DatasetOptions dopt;
  dopt.from = c.from;
  if (c.frames) dopt.frames = c.frames;
  const auto dataset = OpenDataset(c.sequence, dopt);
  auto sink = std::make_shared<Collect>();
  Slam slam(dataset->camera().camera, options,
            c.deterministic ? Execution::kInline : Execution::kThreaded, {sink},
            c.rate == "sensor" ? FeedPolicy::kDropOldest : FeedPolicy::kWait);
  CatchInterrupts();
  PlayOptions play;
  play.read_ahead = !c.deterministic;
  play.rate = c.rate == "sensor" ? PlayRate::kSensor : PlayRate::kMax;
  Play(*dataset, slam, play, InterruptRequested);
  const RunResult& result = slam.Finish();
  const Trajectory final_trajectory = FinalTrajectory(result);
  const Trajectory live = LiveTrajectory(result);
  for (auto& [name, ms] : sink->times) {
    auto v = ms;
    std::sort(v.begin(), v.end());
    double sum = 0;
    for (double x : v)
      sum += x;
    fmt::print("{:12} median {:7.2f} p95 {:7.2f} total {:8.0f}\n", name, v[v.size() / 2],
               v[v.size() * 95 / 100], sum);
  }
  for (auto& [r, n] : sink->reasons)
    fmt::print("{} {}  ", r, n);
  fmt::print("\nkeyframes {} culled {} points {} ba its {} stopped {} dropped {}\n",
             result.snapshot->map.num_keyframes(), sink->culled, result.snapshot->map.num_points(),
             sink->iterations, sink->stopped, result.frames_dropped);
  fmt::print("inliers {:.0f} matches {:.0f} keypoints {:.0f}\n", sink->inliers / sink->n,
             sink->matches / sink->n, sink->kps / sink->n);
  fmt::print("tracked {} of {}\n", final_trajectory.size(), dataset->size());
  if (auto gt = dataset->ground_truth()) {
    const Trajectory reference = ReadTrajectory(*gt);
    for (const auto* t : {&final_trajectory, &live}) {
      const auto ate = EvaluateAte(reference, *t);
      const auto rpe = EvaluateRpe(reference, *t);
      fmt::print("ATE rmse {:.4f} max {:.4f}  RPE rmse {:.4f} max {:.4f}\n", ate.statistics_m.rmse,
                 ate.statistics_m.max, rpe.translation_m.rmse, rpe.translation_m.max);
    }
  }
  return kExitOk;
}

}  // namespace

CLI::App* AddRunCommand(CLI::App& root, int& exit_code) {
  CLI::App* const app = root.add_subcommand("run", "Run SLAM on a recorded sequence");
  const auto command = std::make_shared<RunCommand>();
  app->add_option("sequence", command->sequence, "Folder in TUM layout")->required();
  AddConfigArguments(*app, command->config);
  app->add_flag("--deterministic", command->deterministic, "One thread, same bytes every time");
  app->add_option("--rate", command->rate, "max or sensor")
      ->check(CLI::IsMember({"max", "sensor"}));
  app->add_option("--from", command->from, "First frame");
  app->add_option("--frames", command->frames, "Number of frames");
  AddExamples(*app, {"run my_sequence", "run my_sequence --deterministic"});
  app->callback([command, &exit_code] { exit_code = Run(*command); });
  return app;
}

}  // namespace cslam
