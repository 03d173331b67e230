// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cmd_model_detect.h"

#include "cslam/io/dataset.h"
#include "cslam/io/truth_files.h"
#include "cslam/semantics/make_detector.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "cli_common.h"
#include "exit_codes.h"
#include "input_arguments.h"
#include "interrupt.h"
#include "progress_bar.h"

namespace cslam {
namespace {

namespace fs = std::filesystem;

struct DetectCommand {
  InputArguments input;
  ConfigArguments config;
  std::string model;
  double min_score = 0.0;  // 0: the model's own
  fs::path out;
  bool force = false;
};

// Lower thresholds than a run's: the run that reads the file may still ask for more.
DetectorOptions OptionsOf(const DetectCommand& command) {
  DetectorOptions options = LoadSlamOptions(command.config).detector;
  options.kind = "dnn";
  if (!command.model.empty()) options.model = command.model;
  if (command.min_score > 0.0) {
    options.person_threshold = command.min_score;
    options.object_threshold = command.min_score;
    options.class_thresholds.clear();
  }
  return options;
}

RecordedFrame Record(const Detections& found) {
  RecordedFrame frame{.stamp = found.stamp, .detections = {}};
  for (const Detection& object : found.objects) {
    frame.detections.push_back({.instance = 0,
                                .class_id = object.class_id,
                                .score = object.score,
                                .box = object.box,
                                .visible_px = 0});
  }
  return frame;
}

DetectionRecord DetectAll(const DatasetReader& dataset, Detector& detector) {
  DetectionRecord record;
  ProgressBar progress("detecting", static_cast<int>(dataset.size()));
  for (std::size_t i = 0; i < dataset.size() && !InterruptRequested(); ++i) {
    const LoadResult loaded = dataset.Load(i);
    if (loaded.frame) {
      record.width_px = loaded.frame->gray.cols;
      record.height_px = loaded.frame->gray.rows;
      record.frames.push_back(Record(detector.Detect(*loaded.frame)));
    } else {
      spdlog::warn("{}", loaded.problem);
    }
    progress.Update(static_cast<int>(i + 1));
  }
  return record;
}

int Detect(const DetectCommand& command) {
  CatchInterrupts();
  std::error_code ignored;
  if (fs::exists(command.out, ignored) && !command.force) {
    throw Error("'{}' exists already; name another file or give --force", command.out.string());
  }
  const MadeDetector made = MakeDetector(OptionsOf(command));
  if (!made.warning.empty()) throw Error("{}", made.warning);
  const auto dataset = OpenDataset(command.input.sequence, DatasetOptionsOf(command.input));
  DetectionRecord record = DetectAll(*dataset, *made.detector);
  if (record.frames.empty())
    throw Error("no frame of '{}' could be read", command.input.sequence.string());
  record.sequence =
      fmt::format("{} by {}", fs::absolute(command.input.sequence).filename().string(),
                  made.detector->info().name);
  WriteDetections(command.out, record);
  std::size_t num_boxes = 0;
  for (const RecordedFrame& frame : record.frames)
    num_boxes += frame.detections.size();
  fmt::print("{} boxes in {} of {} frames written to {}\n", num_boxes, record.frames.size(),
             dataset->size(), command.out.string());
  return InterruptRequested() ? kExitInterrupted : kExitOk;
}

}  // namespace

void AddModelDetectCommand(CLI::App& group, int& exit_code) {
  CLI::App* const app = group.add_subcommand(
      "detect", "Write down what a network finds in a recording, for 'run --detections'");
  const auto command = std::make_shared<DetectCommand>();
  AddInputArguments(*app, command->input);
  app->add_option("--out", command->out, "File to write")->type_name("FILE")->required();
  app->add_option("--model", command->model,
                  "Network to use: an installed one's name, or its YAML file (see 'model list')")
      ->type_name("NAME|FILE");
  app->add_option("--min-score", command->min_score,
                  "Least score of a box; default: the model's own, by class")
      ->check(CLI::Range(0.01, 1.0));
  app->add_flag("--force", command->force, "Replace the file if there is one");
  AddConfigArguments(*app, command->config);
  AddExamples(*app, {"model detect my_recording --out my_detections.json",
                     "model detect my_recording --model nanodet-g --min-score 0.2 --out low.json"});
  app->callback([=, &exit_code] { exit_code = Detect(*command); });
}

}  // namespace cslam
