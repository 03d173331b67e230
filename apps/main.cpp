// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include "cli_common.h"
#include "cmd_benchmark.h"
#include "cmd_config.h"
#include "cmd_dataset.h"
#include "cmd_eval.h"
#include "cmd_map.h"
#include "cmd_model.h"
#include "cmd_relocalise.h"
#include "cmd_run.h"
#include "exit_codes.h"
#include "parse_error.h"
#include "version.h"

namespace cslam {
namespace {

// stdout belongs to results, so the log goes to stderr.
void ConfigureLogging(const std::string& level) {
  spdlog::set_default_logger(spdlog::stderr_color_mt("changing-slam"));
  spdlog::set_pattern("%H:%M:%S.%e %^%l%$ %v");
  spdlog::set_level(spdlog::level::from_str(level));
}

struct GlobalArguments {
  std::string log_level = "info";
  bool check_arguments = false;
};

void AddGlobalArguments(CLI::App& root, GlobalArguments& arguments) {
  root.set_version_flag("--version",
                        fmt::format("changing-slam {} (commit {})", Version(), GitCommit()));
  root.add_option("--log-level", arguments.log_level, "How much to say on stderr")
      ->check(CLI::IsMember({"trace", "debug", "info", "warning", "error", "off"}))
      ->capture_default_str();
  // Hidden: lets the tests check the examples of --help without running them.
  root.add_flag("--check-arguments", arguments.check_arguments)->group("");
  root.parse_complete_callback([&arguments] {
    if (arguments.check_arguments) throw CLI::Success();
    ConfigureLogging(arguments.log_level);
  });
}

int RunCommandLine(int argc, const char* const* argv) {
  int exit_code = kExitOk;
  GlobalArguments arguments;
  CLI::App root("RGB-D SLAM for dynamic and changing scenes", "changing-slam");
  root.fallthrough();
  root.require_subcommand(1);
  AddGlobalArguments(root, arguments);
  AddRunCommand(root, exit_code);
  AddEvalCommand(root, exit_code);
  AddDatasetCommand(root, exit_code);
  AddBenchmarkCommand(root, exit_code);
  AddMapCommand(root, exit_code);
  AddRelocaliseCommand(root, exit_code);
  AddModelCommand(root, exit_code);
  AddConfigCommand(root, exit_code);
  AddExamples(root, {"run ~/data/rgbd_dataset_freiburg1_desk --out runs/desk",
                     "eval ate ~/data/rgbd_dataset_freiburg1_desk runs/desk", "run --help"});
  try {
    root.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return ReportParseError(root, error, argc - 1);
  }
  return exit_code;
}

// Further lines would hide the message from a reader and from scripts.
std::string_view FirstLine(std::string_view text) {
  return text.substr(0, text.find('\n'));
}

void PrintError(std::string_view kind, std::string_view message) {
  fmt::print(stderr, "changing-slam: {}: {}\n", kind, FirstLine(message));
}

int RunGuarded(int argc, const char* const* argv) {
  try {
    const int exit_code = RunCommandLine(argc, argv);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      PrintError("error", "cannot write to standard output");
      return kExitRuntimeError;
    }
    return exit_code;
  } catch (const UsageError& error) {
    PrintError("error", error.what());
    return kExitUsage;
  } catch (const Error& error) {
    PrintError("error", error.what());
  } catch (const std::system_error& error) {  // of the file system or of standard output
    PrintError("error", error.what());
  } catch (const std::bad_alloc&) {
    PrintError("error", "out of memory");
  } catch (const std::exception& error) {
    PrintError("internal error",
               fmt::format("{}; please report it with the command line", FirstLine(error.what())));
  }
  return kExitRuntimeError;
}

}  // namespace
}  // namespace cslam

int main(int argc, char** argv) {
  return cslam::RunGuarded(argc, argv);
}
