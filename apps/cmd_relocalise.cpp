// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cmd_relocalise.h"

#include "cslam/atlas_io/map_file.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/pipeline/frame_localiser.h"
#include "cslam/run/map_truth.h"
#include "cslam/run/relocalisation_report.h"
#include "cslam/semantics/make_detector.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <optional>
#include <utility>

#include "cli_common.h"
#include "exit_codes.h"
#include "input_arguments.h"
#include "interrupt.h"

namespace cslam {
namespace {

namespace fs = std::filesystem;

struct RelocaliseCommand {
  fs::path map;
  InputArguments input;
  DetectorArguments detector;
  ConfigArguments config;
  std::optional<fs::path> map_truth;  // of the recording the map was made of
  bool json = false;
};

std::shared_ptr<const MapSnapshot> LoadSnapshot(const fs::path& path, const Camera& camera) {
  SavedMap saved = LoadMap(path);
  if (saved.map.num_keyframes() == 0) {
    throw Error("the map '{}' is empty: nothing was tracked when it was saved", path.string());
  }
  RequireSameCamera(path, saved.info, camera);
  auto snapshot = std::make_shared<MapSnapshot>();
  snapshot->map = saved.map.Snapshot();
  return snapshot;
}

// Nothing where the truth of the frames is not known.
std::optional<MapTruth> ReadTruth(const DatasetReader& dataset, const MapView& map,
                                  const std::optional<fs::path>& map_truth) {
  const auto file = dataset.ground_truth();
  if (!file) return std::nullopt;
  const Trajectory of_frames = ReadTrajectory(*file);
  return MapTruth(map, map_truth ? ReadTrajectory(*map_truth) : of_frames, of_frames);
}

RelocalisationReport FindAll(const DatasetReader& dataset, FrameLocaliser& localiser,
                             const std::optional<MapTruth>& truth) {
  RelocalisationReport report;
  for (std::size_t i = 0; i < dataset.size() && !InterruptRequested(); ++i) {
    const LoadResult loaded = dataset.Load(i);
    if (!loaded.frame) {
      ++report.num_unreadable;
      continue;
    }
    const LocalisedFrame found = localiser.Find(*loaded.frame);
    RelocalisationReport::Frame frame{found, std::nullopt};
    if (truth && found.T_world_camera) {
      frame.error = truth->ErrorOf(found.map, found.stamp, *found.T_world_camera);
    }
    report.frames.push_back(std::move(frame));
  }
  return report;
}

int Relocalise(const RelocaliseCommand& command) {
  CatchInterrupts();
  SlamOptions options = LoadSlamOptions(command.config);
  Apply(command.detector, options.detector);
  const auto dataset = OpenDataset(command.input.sequence, DatasetOptionsOf(command.input));
  const auto map = LoadSnapshot(command.map, dataset->camera().camera);
  MadeDetector made = MakeDetector(options.detector);
  if (!made.warning.empty()) spdlog::warn("{}", made.warning);
  FrameLocaliser localiser(map, dataset->camera().camera, options, std::move(made.detector));
  const std::optional<MapTruth> truth = ReadTruth(*dataset, map->map, command.map_truth);
  if (truth) {
    for (const std::string& problem : truth->problems())
      spdlog::warn("{}", problem);
  }
  RelocalisationReport report = FindAll(*dataset, localiser, truth);
  report.map = command.map;
  report.sequence = command.input.sequence;
  if (truth && truth->IsAligned()) report.keyframe_rmse_m = truth->KeyframeRmse();
  fmt::print("{}", command.json ? FormatRelocalisationJson(report) : FormatRelocalisation(report));
  if (InterruptRequested()) return kExitInterrupted;
  if (CountFound(report) == 0) {
    throw Error("none of {} frames of '{}' was found in the map '{}'", report.frames.size(),
                command.input.sequence.string(), command.map.string());
  }
  return kExitOk;
}

}  // namespace

CLI::App* AddRelocaliseCommand(CLI::App& root, int& exit_code) {
  CLI::App* const app = root.add_subcommand(
      "relocalise", "Find each frame of a sequence in a saved map, knowing nothing of the others");
  const auto command = std::make_shared<RelocaliseCommand>();
  app->add_option("MAP", command->map, "Saved map (see 'run --save-map')")->required();
  AddInputArguments(*app, command->input);
  AddDetectorArguments(*app, command->detector);
  app->add_option(
         "--map-truth", command->map_truth,
         "Ground truth of the recording that the map was made of, in the same world as the "
         "sequence's own; default: that one")
      ->type_name("FILE");
  app->add_flag("--json", command->json, "Print JSON, with every frame, to stdout");
  AddConfigArguments(*app, command->config);
  AddExamples(*app, {"relocalise desk.map ~/data/rgbd_dataset_freiburg1_desk",
                     "relocalise desk.map my_recording --from 300 --frames 50 --json"});
  app->callback([=, &exit_code] { exit_code = Relocalise(*command); });
  return app;
}

}  // namespace cslam
