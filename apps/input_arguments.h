// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/dataset.h"
#include "cslam/semantics/detector_options.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace cslam {

// The recording that a command reads.
struct InputArguments {
  std::filesystem::path sequence;
  CameraChoice camera;
  std::size_t from = 0;
  std::optional<std::size_t> frames;
  bool is_strict = false;
};

// Adds SEQUENCE, --camera, --depth-scale, --from, --frames and --strict. arguments must live until
// the command line is parsed; so with the others here.
void AddInputArguments(CLI::App& app, InputArguments& arguments);
DatasetOptions DatasetOptionsOf(const InputArguments& arguments);

// Which detector looks at it.
struct DetectorArguments {
  std::optional<std::string> detector;
  std::optional<std::string> model;
  std::optional<std::string> detections;
};

// Adds --detector, --model and --detections.
void AddDetectorArguments(CLI::App& app, DetectorArguments& arguments);
void Apply(const DetectorArguments& arguments, DetectorOptions& options);

CLI::Validator WholeNumberFrom(long smallest);

}  // namespace cslam
