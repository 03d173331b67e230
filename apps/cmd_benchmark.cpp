// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cmd_benchmark.h"

#include "cslam/semantics/coco.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "benchmark_steps.h"
#include "cli_common.h"
#include "cmd_render.h"

namespace cslam {
namespace {

namespace fs = std::filesystem;

// As the command line has it.
struct Words {
  BenchmarkArguments arguments;
  std::string form = "short";
  std::string detector = "dnn";
  std::vector<std::string> classes;
  std::vector<std::string> trajectories;  // LABEL=DIR
  ConfigArguments config;
};

// What networks trained on COCO find, of what the sequences show.
constexpr const char* kNetworkClasses[] = {"chair",  "teddy bear",   "tv",       "cup",
                                           "bottle", "potted plant", "umbrella", "suitcase"};

std::set<int> ClassesOf(const Words& words) {
  std::vector<std::string> names = words.classes;
  if (names.empty() && words.detector == "dnn") {
    names.assign(std::begin(kNetworkClasses), std::end(kNetworkClasses));
  }
  std::set<int> classes;
  for (const std::string& name : names) {
    const std::optional<int> class_id = FindCocoClass(name);
    if (!class_id) throw UsageError(fmt::format("--classes: COCO has no class '{}'", name));
    classes.insert(*class_id);
  }
  return classes;
}

BenchmarkDetector DetectorOf(const std::string& name) {
  if (name == "none") return BenchmarkDetector::kNone;
  return name == "dnn" ? BenchmarkDetector::kNetwork : BenchmarkDetector::kPerfect;
}

std::vector<std::pair<std::string, fs::path>> OthersOf(const std::vector<std::string>& texts) {
  std::vector<std::pair<std::string, fs::path>> others;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == text.size()) {
      throw UsageError(fmt::format("--trajectories '{}' is not like orbslam3=runs/orbslam3", text));
    }
    others.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  return others;
}

int Run(Words words) {
  BenchmarkArguments& arguments = words.arguments;
  BenchmarkRequest& request = arguments.request;
  request.is_short = words.form == "short";
  request.folder = fs::absolute(request.folder).lexically_normal();
  if (!request.is_short && request.num_repeats > 1) {
    throw UsageError("--repeats: long forms run inline, which gives the same each time");
  }
  try {
    request.sequences = ResolveSequences(request.sequences);
  } catch (const Error& error) {
    throw UsageError(fmt::format("--sequences: {}", error.what()));
  }
  LoadSlamOptions(words.config);  // a wrong one is told before hours of work
  arguments.detector = DetectorOf(words.detector);
  arguments.classes = ClassesOf(words);
  arguments.others = OthersOf(words.trajectories);
  if (!words.config.file.empty()) {
    arguments.run_options = {"--config", words.config.file.string()};
  }
  for (const std::string& override : words.config.overrides) {
    arguments.run_options.emplace_back("--set");
    arguments.run_options.push_back(override);
  }
  return RunBenchmark(arguments);
}

void AddWhat(CLI::App& app, Words& words) {
  BenchmarkRequest& request = words.arguments.request;
  app.add_option("--out", request.folder, "Renderings, runs and report; goes on with what is there")
      ->type_name("DIR")
      ->required();
  request.sequences = {"six"};
  app.add_option("--sequences", request.sequences,
                 "Names with commas between, the six of the paper's table (six), or all")
      ->type_name("NAME,...")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--form", words.form,
                 "short: at most 40 s each, threaded; long: as long as the paper's, inline")
      ->check(CLI::IsMember({"short", "long"}))
      ->capture_default_str();
  app.add_option("--seeds", request.num_seeds, "Renderings of each sequence")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--first-seed", request.first_seed, "Seed of the first of them")
      ->check(CLI::Range(0, 1'000'000'000))
      ->capture_default_str();
  app.add_option("--repeats", request.num_repeats, "Runs of each rendering")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_flag("--yes", words.arguments.is_confirmed,
               "Do it; otherwise only say what there is to do, how long and how large");
}

void AddHow(CLI::App& app, Words& words) {
  BenchmarkArguments& arguments = words.arguments;
  app.add_option("--detector", words.detector,
                 "The installed network (dnn), the true boxes (perfect), or none")
      ->check(CLI::IsMember({"dnn", "perfect", "none"}))
      ->capture_default_str();
  app.add_option("--model", arguments.model, "Network to use (see 'model list')")
      ->type_name("NAME|FILE");
  app.add_option("--rate", arguments.rate, "Of threaded runs: max, or as recorded (sensor)")
      ->check(CLI::IsMember({"max", "sensor"}))
      ->capture_default_str();
  app.add_option("--classes", words.classes,
                 "COCO classes to judge, with commas between; with a network those it finds in "
                 "the sequences, otherwise all but people")
      ->type_name("NAME,...")
      ->delimiter(',');
  app.add_option("--trajectories", words.trajectories,
                 "Of another system, to be shown beside: a folder with <sequence>.txt, or "
                 "<sequence>-short-<seed>.txt, in TUM format")
      ->type_name("LABEL=DIR");
  AddConfigArguments(app, words.config);
  AddSizeOptions(app, arguments.render.request);
  app.add_option_function<std::string>(
         "--look",
         [&arguments](const std::string& look) { arguments.render.look = ParseLook(look); },
         "Of the renderings, as in 'dataset render'")
      ->check(CLI::IsMember({"auto", "packages", "procedural"}));
  app.add_option("--jobs", arguments.render.jobs, "Threads that render; one for each core")
      ->check(CLI::Range(1, 256));
}

}  // namespace

void AddBenchmarkCommand(CLI::App& root, int& exit_code) {
  CLI::App* const app = root.add_subcommand(
      "benchmark", "Run rendered sequences with the object layer on and off, and compare");
  const auto words = std::make_shared<Words>();
  AddWhat(*app, *words);
  AddHow(*app, *words);
  AddExamples(*app,
              {"benchmark --out bench", "benchmark --out bench --seeds 5 --detector perfect --yes",
               "benchmark --out bench --sequences onechair,office_day --form long --yes",
               "benchmark --out bench --trajectories orbslam3=runs/orbslam3 --yes"});
  app->callback([words, &exit_code] { exit_code = Run(*words); });
}

}  // namespace cslam
