// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "parse_error.h"

#include "cslam/util/options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "exit_codes.h"

namespace cslam {
namespace {

// From the root to the innermost command that was given.
std::vector<const CLI::App*> ChosenCommands(const CLI::App& root) {
  std::vector<const CLI::App*> chain = {&root};
  while (true) {
    const std::vector<CLI::App*> chosen = chain.back()->get_subcommands();
    if (chosen.empty()) return chain;
    chain.push_back(chosen.back());
  }
}

std::vector<std::string> OptionNames(const std::vector<const CLI::App*>& commands) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands) {
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_group().empty()) continue;  // hidden
      for (const std::string& name : option->get_lnames())
        names.push_back("--" + name);
    }
  }
  return names;
}

std::vector<std::string> SubcommandNames(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* subcommand : command.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(subcommand->get_name());
  return names;
}

std::string Suggestion(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string nearest = NearestName(name, candidates);
  return nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest);
}

// What to say about an argument nobody took.
std::string UnknownArgument(const std::string& argument,
                            const std::vector<const CLI::App*>& commands) {
  if (argument.starts_with("-") && argument.size() > 1) {
    const std::string name = argument.substr(0, argument.find('='));
    return fmt::format("unknown option '{}'{}", name,
                       name.starts_with("--") ? Suggestion(name, OptionNames(commands)) : "");
  }
  const std::vector<std::string> subcommands = SubcommandNames(*commands.back());
  if (!subcommands.empty())
    return fmt::format("unknown command '{}'{}", argument, Suggestion(argument, subcommands));
  return fmt::format("unexpected argument '{}'", argument);
}

std::string FirstLine(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

std::string Message(const CLI::App& root, const CLI::ParseError& error) {
  const std::vector<const CLI::App*> commands = ChosenCommands(root);
  for (const CLI::App* command : commands) {
    const std::vector<std::string> remaining = command->remaining();
    if (!remaining.empty()) return UnknownArgument(remaining.front(), commands);
  }
  const std::vector<std::string> subcommands = SubcommandNames(*commands.back());
  if (!subcommands.empty() && error.get_name() == "RequiredError")
    return fmt::format("expected a command: {}", fmt::join(subcommands, ", "));
  return FirstLine(error.what());
}

std::string HelpCommand(const CLI::App& root) {
  std::string command;
  for (const CLI::App* app : ChosenCommands(root))
    command += app->get_name() + ' ';
  return command + "--help";
}

}  // namespace

int ReportParseError(const CLI::App& root, const CLI::ParseError& error, int num_arguments) {
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
    if (error.get_name() == "CallForHelp") fmt::print("{}", root.help());
    if (error.get_name() == "CallForVersion") fmt::print("{}\n", error.what());
    return kExitOk;
  }
  if (num_arguments == 0) {
    fmt::print(stderr, "{}", root.help());
    return kExitUsage;
  }
  fmt::print(stderr, "changing-slam: error: {} (see '{}')\n", Message(root, error),
             HelpCommand(root));
  return kExitUsage;
}

}  // namespace cslam
