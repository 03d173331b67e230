// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "input_arguments.h"

#include "cslam/io/camera_file.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace cslam {

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

void AddInputArguments(CLI::App& app, InputArguments& arguments) {
  app.add_option("sequence", arguments.sequence, "Folder in the layout of the TUM RGB-D benchmark")
      ->required();
  app.add_option("--camera", arguments.camera.camera,
                 "Camera file, or one of: " + DescribeCameraPresets())
      ->type_name("NAME|FILE");
  app.add_option("--depth-scale", arguments.camera.depth_units_per_m,
                 "Value of a depth pixel one metre away, instead of the camera's")
      ->type_name("UNITS");
  app.add_option("--from", arguments.from, "Index of the first frame to play")
      ->type_name("N")
      ->check(WholeNumberFrom(0))
      ->capture_default_str();
  app.add_option("--frames", arguments.frames, "How many frames to play at most; all by default")
      ->type_name("N")
      ->check(WholeNumberFrom(1));
  app.add_flag("--strict", arguments.is_strict, "Stop at a frame that cannot be read");
}

DatasetOptions DatasetOptionsOf(const InputArguments& arguments) {
  return {.camera = arguments.camera,
          .from = arguments.from,
          .frames = arguments.frames,
          .is_strict = arguments.is_strict};
}

void AddDetectorArguments(CLI::App& app, DetectorArguments& arguments) {
  app.add_option(
         "--detector", arguments.detector,
         "What finds people and objects: a network (dnn, the default), a file (recorded) or "
         "nothing (none)")
      ->check(CLI::IsMember({"dnn", "recorded", "none"}));
  app.add_option("--model", arguments.model,
                 "Network to use: an installed one's name, or its YAML file (see 'model list')")
      ->type_name("NAME|FILE");
  app.add_option("--detections", arguments.detections,
                 "Detections recorded earlier, in the format of detections.json; implies "
                 "--detector recorded")
      ->type_name("FILE");
}

void Apply(const DetectorArguments& arguments, DetectorOptions& options) {
  if (arguments.detections) {
    options.detections = *arguments.detections;
    options.kind = "recorded";
  }
  if (arguments.model) options.model = *arguments.model;
  if (arguments.detector) options.kind = *arguments.detector;
}

}  // namespace cslam
