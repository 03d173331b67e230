// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cmd_config.h"

#include "cslam/io/config.h"

#include <CLI/CLI.hpp>

#include <memory>

#include "cli_common.h"
#include "exit_codes.h"

namespace cslam {
namespace {

struct ConfigCommand {
  ConfigArguments config;
  bool markdown = false;
  bool yaml = false;
};

std::string TextOf(const ConfigCommand& command) {
  SlamOptions options = LoadSlamOptions(command.config);
  OptionList list;
  Describe(list, options);
  if (command.yaml) return DumpYaml(list);
  if (command.markdown) return DumpMarkdown(list);
  SlamOptions defaults;
  OptionList default_list;
  Describe(default_list, defaults);
  return DumpTable(list, default_list);
}

}  // namespace

CLI::App* AddConfigCommand(CLI::App& root, int& exit_code) {
  CLI::App* const app =
      root.add_subcommand("config", "Print every option: name, value, unit, range and meaning");
  const auto command = std::make_shared<ConfigCommand>();
  AddConfigArguments(*app, command->config);
  CLI::Option* const yaml =
      app->add_flag("--yaml", command->yaml, "Print a file that --config takes");
  app->add_flag("--markdown", command->markdown, "Print docs/config.md")->excludes(yaml);
  AddExamples(*app, {"config", "config --yaml > my.yaml", "config --markdown"});
  app->callback([command, &exit_code] {
    fmt::print("{}", TextOf(*command));
    exit_code = kExitOk;
  });
  return app;
}

}  // namespace cslam
