// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cli_common.h"

#include "cslam/io/config.h"

#include <CLI/CLI.hpp>

namespace cslam {

void AddConfigArguments(CLI::App& command, ConfigArguments& arguments) {
  command.add_option("--config", arguments.file, "YAML file with options")->type_name("FILE");
  command.add_option("--set", arguments.overrides, "Set one option; repeat for more")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->take_all();
}

SlamOptions LoadSlamOptions(const ConfigArguments& arguments) {
  SlamOptions options;
  OptionList list;
  Describe(list, options);
  if (!arguments.file.empty()) LoadYaml(arguments.file, list);
  try {
    ApplyOverrides(arguments.overrides, list);
  } catch (const Error& error) {
    throw UsageError(fmt::format("--set: {}", error.what()));
  }
  return options;
}

void AddExamples(CLI::App& command, const std::vector<std::string>& examples) {
  std::string footer = "Examples:";
  for (const std::string& example : examples)
    footer += "\n  changing-slam " + example;
  command.footer(footer);
}

}  // namespace cslam
