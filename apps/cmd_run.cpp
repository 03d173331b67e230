// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cmd_run.h"

#include "cslam/run/frame_pictures.h"
#include "cslam/run/progress.h"
#include "cslam/run/run_summary.h"
#include "cslam/run/run_writer.h"
#include "cslam/semantics/make_detector.h"

#include <CLI/CLI.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <ctime>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "cli_common.h"
#include "exit_codes.h"
#include "interrupt.h"
#include "version.h"

namespace cslam {
namespace {

namespace fs = std::filesystem;

struct RunCommand {
  fs::path sequence;
  fs::path out;  // empty: runs/<sequence>-<date>-<time>
  ConfigArguments config;
  CameraChoice camera;
  std::size_t from = 0;
  std::optional<std::size_t> frames;
  std::string rate = "max";
  std::optional<std::string> detector;
  std::optional<std::string> model;
  std::optional<std::string> detections;
  std::optional<std::string> schedule;
  std::optional<std::size_t> save_frames;  // every how many; absent: none
  bool is_deterministic = false;
  bool is_strict = false;
};

RunSettings SettingsOf(const RunCommand& command) {
  RunSettings settings;
  if (command.rate == "sensor") settings.rate = PlayRate::kSensor;
  if (command.is_deterministic) settings.execution = Execution::kInline;
  if (command.is_deterministic && settings.rate == PlayRate::kSensor) {
    throw UsageError(
        "--deterministic and --rate sensor exclude each other: which frames are dropped depends "
        "on the clock");
  }
  return settings;
}

SlamOptions OptionsOf(const RunCommand& command) {
  SlamOptions options = LoadSlamOptions(command.config);
  if (command.detections) {
    options.detector.detections = *command.detections;
    options.detector.kind = "recorded";
  }
  if (command.model) options.detector.model = *command.model;
  if (command.detector) options.detector.kind = *command.detector;
  if (command.save_frames) options.tracking.report_keypoints = true;
  if (command.schedule) options.detection.schedule = *command.schedule;
  if (command.is_deterministic && options.pipeline.library_threads != 1) {
    throw UsageError(fmt::format(
        "--deterministic runs on one thread, but pipeline.library_threads is {}; leave it at 1",
        options.pipeline.library_threads));
  }
  return options;
}

DatasetOptions DatasetOptionsOf(const RunCommand& command) {
  return {.camera = command.camera,
          .from = command.from,
          .frames = command.frames,
          .is_strict = command.is_strict};
}

std::string ScheduleName(const SlamOptions& options, const RunSettings& settings) {
  const bool is_inline = settings.execution == Execution::kInline;
  return ScheduleOf(options.detection, is_inline) == DetectionSchedule::kLive ? "live"
                                                                              : "every-frame";
}

// A folder that is not there yet.
fs::path DefaultFolder(const fs::path& sequence) {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  const fs::path folder =
      fs::path("runs") / fmt::format("{}-{:%Y%m%d-%H%M%S}", SequenceName(sequence), local);
  fs::path unused = folder;
  for (int attempt = 2; fs::exists(unused); ++attempt)
    unused = fmt::format("{}-{}", folder.string(), attempt);
  return unused;
}

void Announce(const DatasetReader& dataset, const fs::path& folder) {
  const CameraConfig& camera = dataset.camera();
  spdlog::info("camera: {} ({}), {}x{} px, {} depth units per metre", camera.name, camera.source,
               camera.camera.width, camera.camera.height, camera.depth_units_per_m);
  if (camera.approximate) {
    spdlog::warn("camera {} is approximate: calibrate yours and pass it with --camera FILE",
                 camera.name);
  }
  spdlog::info("frames: {}, results: {}", dataset.size(), folder.string());
}

std::vector<std::shared_ptr<OutputSink>> MakeListeners(const RunCommand& command,
                                                       const DatasetReader& dataset,
                                                       const fs::path& folder) {
  std::vector<std::shared_ptr<OutputSink>> listeners;
  if (command.save_frames) {
    listeners.push_back(std::make_shared<FramePictures>(dataset, folder / "frames", command.from,
                                                        *command.save_frames));
  }
  if (!spdlog::should_log(spdlog::level::info)) return listeners;
  ProgressOptions options;
  if (isatty(STDERR_FILENO) != 0) options.style = ProgressStyle::kBar;
  options.first_frame = command.from;
  options.num_frames = dataset.size();
  listeners.push_back(std::make_shared<ProgressSink>(stderr, options));
  return listeners;
}

void Warn(const RunReport& report) {
  const FrameCounts& frames = report.frames;
  if (frames.unreadable > 0) {
    spdlog::warn("{} of {} frames could not be read and were skipped; the first: {}",
                 frames.unreadable, frames.input, report.frame_problems.front());
  }
  for (const std::string& problem : report.accuracy.problems)
    spdlog::warn("{}", problem);
  if (report.was_interrupted) {
    spdlog::warn("interrupted after {} frames; the results are those so far", frames.input);
  }
}

int ExitCodeOf(const RunReport& report) {
  if (report.was_interrupted) return kExitInterrupted;
  if (report.frames.in_trajectory == 0) {
    throw Error("no frame of '{}' was tracked: {} (is the depth right? see 'dataset check')",
                report.identity.sequence.string(), report.last_reason);
  }
  return kExitOk;
}

int Run(const RunCommand& command) {
  CatchInterrupts();
  // A file that grows beyond its limit is then an error of the write, not the end of the program.
  std::signal(SIGXFSZ, SIG_IGN);
  const RunSettings settings = SettingsOf(command);
  const SlamOptions options = OptionsOf(command);
  const auto dataset = OpenDataset(command.sequence, DatasetOptionsOf(command));
  const fs::path folder = command.out.empty() ? DefaultFolder(command.sequence) : command.out;
  MadeDetector made = MakeDetector(options.detector);
  if (!made.warning.empty()) spdlog::warn("{}", made.warning);
  const DetectorInfo detector = made.detector->info();
  PrepareRunFolder(folder);
  Announce(*dataset, folder);
  const RunOutcome outcome =
      RunSequence(*dataset, options, settings, std::move(made.detector),
                  MakeListeners(command, *dataset, folder), InterruptRequested);
  const RunTrajectories trajectories = ExtractTrajectories(outcome.result);
  const RunReport report = MakeReport({.version = std::string(Version()),
                                       .commit = std::string(GitCommit()),
                                       .arguments = CommandLineArguments(),
                                       .sequence = command.sequence,
                                       .folder = folder,
                                       .settings = settings,
                                       .detector = detector,
                                       .schedule = ScheduleName(options, settings)},
                                      *dataset, outcome, trajectories);
  std::optional<Error> write_failure;
  try {
    WriteRunFolder(report, outcome, trajectories, *dataset, options);
  } catch (const Error& error) {
    write_failure = error;  // what was found is worth telling all the same
  }
  Warn(report);
  fmt::print("{}", FormatRunSummary(report));
  if (write_failure) throw Error(*write_failure);
  return ExitCodeOf(report);
}

// The ready-made validators speak of ranges up to the largest double.
CLI::Validator WholeNumberFrom(long smallest) {
  return CLI::Validator(
      [smallest](const std::string& text) -> std::string {
        long value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= smallest) return "";
        return fmt::format("'{}' is not a whole number of at least {}", text, smallest);
      },
      "");
}

void AddInputArguments(CLI::App& app, RunCommand& command) {
  app.add_option("sequence", command.sequence, "Folder in the layout of the TUM RGB-D benchmark")
      ->required();
  app.add_option("--camera", command.camera.camera,
                 "Camera file, or one of: " + DescribeCameraPresets())
      ->type_name("NAME|FILE");
  app.add_option("--depth-scale", command.camera.depth_units_per_m,
                 "Value of a depth pixel one metre away, instead of the camera's")
      ->type_name("UNITS");
  app.add_option("--from", command.from, "Index of the first frame to play")
      ->type_name("N")
      ->check(WholeNumberFrom(0))
      ->capture_default_str();
  app.add_option("--frames", command.frames, "How many frames to play at most; all by default")
      ->type_name("N")
      ->check(WholeNumberFrom(1));
  app.add_flag("--strict", command.is_strict, "Stop at a frame that cannot be read");
}

void AddModeArguments(CLI::App& app, RunCommand& command) {
  app.add_option("--out", command.out,
                 "Folder for the results (default: runs/<sequence>-<date>-<time>)")
      ->type_name("DIR");
  app.add_option("--rate", command.rate,
                 "As fast as possible without dropping a frame (max), or as recorded, dropping "
                 "frames that wait too long (sensor)")
      ->check(CLI::IsMember({"max", "sensor"}))
      ->capture_default_str();
  app.add_option("--save-frames", command.save_frames,
                 "Write a picture of every N-th frame with its keypoints and objects into "
                 "DIR/frames")
      ->type_name("N")
      ->check(WholeNumberFrom(1));
  app.add_flag("--deterministic", command.is_deterministic,
               "One thread for everything: equal input gives equal files");
}

void AddDetectorArguments(CLI::App& app, RunCommand& command) {
  app.add_option(
         "--detector", command.detector,
         "What finds people and objects: a network (dnn, the default), a file (recorded) or "
         "nothing (none)")
      ->check(CLI::IsMember({"dnn", "recorded", "none"}));
  app.add_option("--model", command.model,
                 "Network to use: an installed one's name, or its YAML file (see 'model list')")
      ->type_name("NAME|FILE");
  app.add_option("--detections", command.detections,
                 "Detections recorded earlier, in the format of detections.json; implies "
                 "--detector recorded")
      ->type_name("FILE");
  app.add_option("--schedule", command.schedule,
                 "Wait for each frame's detections (every-frame; the default with "
                 "--deterministic), or never wait (live; the default otherwise)")
      ->check(CLI::IsMember({"auto", "every-frame", "live"}));
}

}  // namespace

CLI::App* AddRunCommand(CLI::App& root, int& exit_code) {
  CLI::App* const app = root.add_subcommand("run", "Run SLAM on a recorded sequence");
  const auto command = std::make_shared<RunCommand>();
  AddInputArguments(*app, *command);
  AddModeArguments(*app, *command);
  AddDetectorArguments(*app, *command);
  AddConfigArguments(*app, command->config);
  AddExamples(*app, {"run ~/data/rgbd_dataset_freiburg1_desk",
                     "run my_recording --camera d435i --depth-scale 1000 --out runs/mine",
                     "run my_recording --model nanodet-plus-m --schedule every-frame",
                     "run my_recording --from 100 --frames 200 --deterministic",
                     "run my_recording --rate sensor --set tracking.orb.num_features=1500"});
  app->callback([=, &exit_code] { exit_code = Run(*command); });
  return app;
}

}  // namespace cslam
