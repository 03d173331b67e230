// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cmd_run.h"

#include "cslam/atlas_io/map_file.h"
#include "cslam/run/frame_pictures.h"
#include "cslam/run/map_saver.h"
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
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "cli_common.h"
#include "exit_codes.h"
#include "input_arguments.h"
#include "interrupt.h"
#include "version.h"

namespace cslam {
namespace {

namespace fs = std::filesystem;

struct RunCommand {
  InputArguments input;
  fs::path out;  // empty: runs/<sequence>-<date>-<time>
  ConfigArguments config;
  std::string rate = "max";
  DetectorArguments detector;
  std::optional<std::string> schedule;
  std::optional<std::size_t> save_frames;  // every how many; absent: none
  std::optional<fs::path> map;             // to go on in
  std::optional<fs::path> save_map;
  double save_every_s = 30.0;
  bool is_localise_only = false;
  bool is_deterministic = false;
};

RunSettings SettingsOf(const RunCommand& command) {
  RunSettings settings;
  if (command.rate == "sensor") settings.rate = PlayRate::kSensor;
  if (command.is_deterministic) settings.execution = Execution::kInline;
  if (command.is_localise_only) settings.mode = TrackingMode::kLocaliseOnly;
  if (command.is_deterministic && settings.rate == PlayRate::kSensor) {
    throw UsageError(
        "--deterministic and --rate sensor exclude each other: which frames are dropped depends "
        "on the clock");
  }
  return settings;
}

SlamOptions OptionsOf(const RunCommand& command) {
  SlamOptions options = LoadSlamOptions(command.config);
  Apply(command.detector, options.detector);
  if (command.save_frames) options.tracking.report_keypoints = true;
  if (command.schedule) options.detection.schedule = *command.schedule;
  if (command.is_deterministic && options.pipeline.library_threads != 1) {
    throw UsageError(fmt::format(
        "--deterministic runs on one thread, but pipeline.library_threads is {}; leave it at 1",
        options.pipeline.library_threads));
  }
  return options;
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

// Throws Error for a map that cannot be gone on in.
std::optional<SavedMap> LoadEarlierMap(const RunCommand& command, const Camera& camera) {
  if (!command.map) return std::nullopt;
  SavedMap saved = LoadMap(*command.map);
  if (saved.map.num_keyframes() == 0) {
    throw Error("the map '{}' is empty: nothing was tracked when it was saved",
                command.map->string());
  }
  RequireSameCamera(*command.map, saved.info, camera);
  return saved;
}

std::string UtcNow() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", utc);
}

MapFileInfo InfoOfMap(const RunCommand& command, const CameraConfig& camera,
                      const SlamOptions& options, const std::optional<SavedMap>& earlier) {
  MapFileInfo info;
  info.program = ProgramName();
  if (!command.is_deterministic) info.created = UtcNow();
  info.camera = camera;
  info.level_scales = LevelScales(options.tracking.orb);
  if (earlier) {
    info.sessions = earlier->info.sessions;
    info.sessions.resize(earlier->map.sessions().size());
  }
  info.sessions.push_back(SequenceName(command.input.sequence));
  return info;
}

std::shared_ptr<MapSaver> MakeSaver(const RunCommand& command, const CameraConfig& camera,
                                    const SlamOptions& options, const RunSettings& settings,
                                    const std::optional<SavedMap>& earlier) {
  if (!command.save_map) return nullptr;
  return std::make_shared<MapSaver>(
      MapSaverOptions{.path = *command.save_map,
                      .info = InfoOfMap(command, camera, options, earlier),
                      .every_s = command.save_every_s,
                      .execution = settings.execution});
}

std::vector<std::shared_ptr<OutputSink>> MakeListeners(const RunCommand& command,
                                                       const DatasetReader& dataset,
                                                       const fs::path& folder) {
  std::vector<std::shared_ptr<OutputSink>> listeners;
  if (command.save_frames) {
    listeners.push_back(std::make_shared<FramePictures>(dataset, folder / "frames",
                                                        command.input.from, *command.save_frames));
  }
  if (!spdlog::should_log(spdlog::level::info)) return listeners;
  ProgressOptions options;
  if (isatty(STDERR_FILENO) != 0) options.style = ProgressStyle::kBar;
  options.first_frame = command.input.from;
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
  const bool has_found_none = report.frames.in_trajectory > 0 && report.map.earlier_keyframes == 0;
  if (!report.identity.map.empty() && has_found_none) {
    spdlog::warn(
        "no place of the map '{}' was recognised: the results are in the world of a new map",
        report.identity.map.string());
  }
  if (report.was_interrupted) {
    spdlog::warn("interrupted after {} frames; the results are those so far", frames.input);
  }
}

int ExitCodeOf(const RunReport& report) {
  if (report.was_interrupted) return kExitInterrupted;
  if (report.frames.in_trajectory == 0 &&
      report.identity.settings.mode == TrackingMode::kLocaliseOnly) {
    throw Error("no frame of '{}' was found in the map '{}': {}", report.identity.sequence.string(),
                report.identity.map.string(), report.last_reason);
  }
  if (report.frames.in_trajectory == 0) {
    throw Error("no frame of '{}' was tracked: {} (is the depth right? see 'dataset check')",
                report.identity.sequence.string(), report.last_reason);
  }
  return kExitOk;
}

void CheckMapArguments(const RunCommand& command) {
  if (!command.is_localise_only) return;
  if (!command.map) throw UsageError("--localise-only needs a map to localise in: --map FILE");
  if (command.save_map) {
    throw UsageError("--localise-only changes nothing in the map: there is nothing to --save-map");
  }
}

RunIdentity IdentityOf(const RunCommand& command, const fs::path& folder,
                       const RunSettings& settings, const SlamOptions& options,
                       const Detector& detector) {
  return {.version = std::string(Version()),
          .commit = std::string(GitCommit()),
          .arguments = CommandLineArguments(),
          .sequence = command.input.sequence,
          .folder = folder,
          .settings = settings,
          .detector = detector.info(),
          .schedule = ScheduleName(options, settings),
          .map = command.map.value_or(fs::path()),
          .save_map = command.save_map.value_or(fs::path())};
}

// Keeps the first error, so that what comes after is done all the same.
class Failures {
 public:
  void Try(const std::function<void()>& step) {
    try {
      step();
    } catch (const Error& error) {
      if (!first_) first_ = error;
    }
  }
  void ThrowFirst() const {
    if (first_) throw Error(*first_);
  }

 private:
  std::optional<Error> first_;
};

void SaveFinalMap(MapSaver& saver, const RunOutcome& outcome) {
  const bool is_saved = saver.SaveFinal(*outcome.result.snapshot);
  for (const std::string& problem : saver.problems())
    spdlog::warn("{}", problem);
  if (!is_saved) spdlog::warn("the map is empty and was not saved");
}

int Run(const RunCommand& command) {
  CheckMapArguments(command);
  CatchInterrupts();
  // A file that grows beyond its limit is then an error of the write, not the end of the program.
  std::signal(SIGXFSZ, SIG_IGN);
  const RunSettings settings = SettingsOf(command);
  const SlamOptions options = OptionsOf(command);
  const auto dataset = OpenDataset(command.input.sequence, DatasetOptionsOf(command.input));
  std::optional<SavedMap> earlier = LoadEarlierMap(command, dataset->camera().camera);
  const fs::path folder = command.out.empty() ? DefaultFolder(command.input.sequence) : command.out;
  MadeDetector made = MakeDetector(options.detector);
  if (!made.warning.empty()) spdlog::warn("{}", made.warning);
  const auto saver = MakeSaver(command, dataset->camera(), options, settings, earlier);
  PrepareRunFolder(folder);
  Announce(*dataset, folder);
  RunIdentity identity = IdentityOf(command, folder, settings, options, *made.detector);

  RunParts parts{.detector = std::move(made.detector),
                 .listeners = MakeListeners(command, *dataset, folder)};
  if (saver) parts.listeners.push_back(saver);
  if (earlier) parts.map = std::move(earlier->map);
  const RunOutcome outcome =
      RunSequence(*dataset, options, settings, std::move(parts), InterruptRequested);
  Failures failures;
  if (saver) failures.Try([&] { SaveFinalMap(*saver, outcome); });
  const RunTrajectories trajectories = ExtractTrajectories(outcome.result);
  const RunReport report = MakeReport(std::move(identity), *dataset, outcome, trajectories);
  failures.Try([&] { WriteRunFolder(report, outcome, trajectories, *dataset, options); });
  Warn(report);  // what was found is worth telling even where it could not be written
  fmt::print("{}", FormatRunSummary(report));
  failures.ThrowFirst();
  return ExitCodeOf(report);
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

void AddMapArguments(CLI::App& app, RunCommand& command) {
  app.add_option("--map", command.map,
                 "Go on in the map of an earlier run; a new map starts if no place of it is "
                 "recognised, and is merged with it when one is")
      ->type_name("FILE");
  app.add_flag("--localise-only", command.is_localise_only,
               "Poses in --map as it is: no new keyframes, no changes");
  CLI::Option* const save_map =
      app.add_option("--save-map", command.save_map,
                     "Keep the map in this file: while it grows, at the end, and on Ctrl-C")
          ->type_name("FILE");
  app.add_option("--save-every", command.save_every_s,
                 "How much of the recording to map between two saves, which is what killing the "
                 "program loses at most")
      ->type_name("SECONDS")
      ->check(CLI::Range(0.1, 1e6))
      ->capture_default_str()
      ->needs(save_map);
}

void AddScheduleArgument(CLI::App& app, RunCommand& command) {
  app.add_option("--schedule", command.schedule,
                 "Wait for each frame's detections (every-frame; the default with "
                 "--deterministic), or never wait (live; the default otherwise)")
      ->check(CLI::IsMember({"auto", "every-frame", "live"}));
}

}  // namespace

CLI::App* AddRunCommand(CLI::App& root, int& exit_code) {
  CLI::App* const app = root.add_subcommand("run", "Run SLAM on a recorded sequence");
  const auto command = std::make_shared<RunCommand>();
  AddInputArguments(*app, command->input);
  AddModeArguments(*app, *command);
  AddMapArguments(*app, *command);
  AddDetectorArguments(*app, command->detector);
  AddScheduleArgument(*app, *command);
  AddConfigArguments(*app, command->config);
  AddExamples(*app,
              {"run ~/data/rgbd_dataset_freiburg1_desk",
               "run my_recording --camera d435i --depth-scale 1000 --out runs/mine",
               "run my_recording --model nanodet-plus-m --schedule every-frame",
               "run my_recording --from 100 --frames 200 --deterministic",
               "run monday --save-map room.map", "run tuesday --map room.map --save-map room.map",
               "run wednesday --map room.map --localise-only",
               "run my_recording --rate sensor --set tracking.orb.num_features=1500"});
  app->callback([=, &exit_code] { exit_code = Run(*command); });
  return app;
}

}  // namespace cslam
