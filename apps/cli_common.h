// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/pipeline/slam_options.h"
#include "cslam/util/check.h"

#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace cslam {

// A fault in the command line itself: exit code 2 instead of 1.
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& message) : Error("{}", message) {}
};

// What --config and --set were given.
struct ConfigArguments {
  std::filesystem::path file;          // empty: none
  std::vector<std::string> overrides;  // "key=value", applied in order after the file
};

// Adds --config and --set. arguments must live until the command line is parsed.
void AddConfigArguments(CLI::App& command, ConfigArguments& arguments);

// Defaults, then the file, then the overrides. Throws Error for a bad file and UsageError for a
// bad override.
SlamOptions LoadSlamOptions(const ConfigArguments& arguments);

// Ends the --help of a command. Each example is the command line after "changing-slam ".
void AddExamples(CLI::App& command, const std::vector<std::string>& examples);

}  // namespace cslam
