// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cmd_render.h"

#include "cslam/util/text_table.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <system_error>

#include "cli_common.h"
#include "exit_codes.h"
#include "render_sequences.h"

namespace cslam {
namespace {

constexpr int kMinSizePx = 32;
constexpr int kMaxSizePx = 4096;

// "640x480" -> width and height; throws what CLI11 reports as a usage error.
void ParseSize(const std::string& text, RenderRequest& request) {
  const char* const end = text.data() + text.size();
  int width = 0;
  int height = 0;
  const auto [cross, width_error] = std::from_chars(text.data(), end, width);
  const bool has_width = width_error == std::errc() && cross != end && *cross == 'x';
  const auto [rest, height_error] = std::from_chars(has_width ? cross + 1 : end, end, height);
  if (!has_width || height_error != std::errc() || rest != end)
    throw CLI::ValidationError("--size", fmt::format("'{}' is not like 640x480", text));
  const auto [low, high] = std::minmax(width, height);
  if (low < kMinSizePx || high > kMaxSizePx) {
    throw CLI::ValidationError(
        "--size", fmt::format("'{}' is outside {} to {} px a side", text, kMinSizePx, kMaxSizePx));
  }
  request.width = width;
  request.height = height;
}

SensorNoise ParseNoise(const std::string& name) {
  if (name == "off") return SensorNoise::kOff;
  return name == "kinect" ? SensorNoise::kKinect : SensorNoise::kD435i;
}

// The range check of CLI11 lets "nan" pass. Empty: nothing to object to.
std::string WhyNotFinite(const std::string& text) {
  double value = 0.0;
  const bool is_number = CLI::detail::lexical_cast(text, value);
  return is_number && std::isfinite(value) ? "" : fmt::format("'{}' is not a number", text);
}

// Conversion to an unsigned number would wrap negative ones around and cut off large ones.
std::string WhyNoSeed(const std::string& text) {
  std::uint64_t seed = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, seed);
  if (error == std::errc() && rest == end) return "";
  return fmt::format("'{}' is no whole number from 0 to 2^64 - 1", text);
}

}  // namespace

void AddSizeOptions(CLI::App& app, RenderRequest& request) {
  app.add_option("--frames", request.num_frames, "At most so many; the whole story unless told")
      ->check(CLI::Range(1, 1'000'000));
  app.add_option("--fps", request.fps, "Frames per second; the story takes as long as ever")
      ->check(CLI::Range(0.1, 1000.0) & CLI::Validator(WhyNotFinite, "", "finite"))
      ->capture_default_str();
  app.add_option_function<std::string>(
         "--size", [&request](const std::string& text) { ParseSize(text, request); },
         "Size of the images (640x480 unless told)")
      ->type_name("WxH");
}

namespace {

void AddStoryOptions(CLI::App& app, RenderRequest& request) {
  AddSizeOptions(app, request);
  app.add_option_function<std::string>(
         "--noise", [&request](const std::string& name) { request.noise = ParseNoise(name); },
         "As such a sensor sees (that of the sequence unless told); off: exact")
      ->check(CLI::IsMember({"off", "kinect", "d435i"}));
  app.add_option("--seed", request.seed, "Other textures, things, small movements and noise")
      ->check(CLI::Validator(WhyNoSeed, "", "seed"))
      ->capture_default_str();
  app.add_flag("--short", request.is_short, "The same story within 40 s");
  app.add_flag("--without-people", request.without_people,
               "Leave people out, to compare with; what they carry moves all the same");
  app.add_option("--without", request.without,
                 "Leave out an object by its name in objects.json; can be repeated")
      ->type_name("NAME")
      ->allow_extra_args(false);
}

void AddRender(CLI::App& dataset, int& exit_code) {
  CLI::App* const app = dataset.add_subcommand(
      "render",
      "Render a sequence with ground truth (TUM layout); the files depend on its "
      "options alone, not on the number of jobs or on interruptions");
  const auto arguments = std::make_shared<RenderArguments>();
  app->add_option("name", arguments->names,
                  "Which one; 'dataset list' names them. Several, or 'all': a folder each")
      ->required();
  app->add_option("--out", arguments->folder, "New or empty folder")->type_name("DIR")->required();
  AddStoryOptions(*app, arguments->request);
  app->add_option_function<std::string>(
         "--look", [arguments](const std::string& look) { arguments->look = ParseLook(look); },
         "packages: models and textures of Debian packages, fetched once; procedural: plain, "
         "without any; auto (unless told): packages where they can be had")
      ->check(CLI::IsMember({"auto", "packages", "procedural"}));
  app->add_option("--jobs", arguments->jobs, "Threads; one for each core unless told")
      ->check(CLI::Range(1, 256));
  CLI::Option* const resume = app->add_flag_callback(
      "--resume", [arguments] { arguments->existing = ExistingFolder::kResume; },
      "Go on with an interrupted rendering in the folder");
  app->add_flag_callback(
         "--force", [arguments] { arguments->existing = ExistingFolder::kReplace; },
         "Replace the rendered sequence that is in the folder; other files stay")
      ->excludes(resume);
  AddExamples(*app, {"dataset render demo --out data/demo",
                     "dataset render walking_xyz --out data/walking_xyz",
                     "dataset render changing onechair --short --out data",
                     "dataset render demo --out data/small --size 320x240 --fps 15 --noise off"});
  app->callback([arguments, &exit_code] { exit_code = RenderSequences(*arguments); });
}

std::string_view NameOf(SensorKind sensor) {
  return sensor == SensorKind::kKinect ? "kinect" : "d435i";
}

int PrintListJson() {
  auto list = nlohmann::ordered_json::array();
  for (const SequenceEntry& entry : RenderableSequences()) {
    list.push_back({{"name", entry.name},
                    {"duration_s", entry.duration_s},
                    {"short_duration_s", entry.short_duration_s},
                    {"sensor", NameOf(entry.sensor)},
                    {"summary", entry.summary}});
  }
  fmt::print("{}\n", list.dump(2));
  return kExitOk;
}

int PrintList() {
  TextTable table({{"name"},
                   {"length", TextAlign::kRight},
                   {"short", TextAlign::kRight},
                   {"sensor"},
                   {"what"}});
  for (const SequenceEntry& entry : RenderableSequences()) {
    table.AddRow({std::string(entry.name), fmt::format("{:.0f} s", entry.duration_s),
                  fmt::format("{:.0f} s", entry.short_duration_s),
                  std::string(NameOf(entry.sensor)), std::string(entry.summary)});
  }
  fmt::print("{}", table.Text());
  return kExitOk;
}

}  // namespace

void AddRenderCommands(CLI::App& dataset, int& exit_code) {
  AddRender(dataset, exit_code);
  CLI::App* const list = dataset.add_subcommand("list", "Name the sequences that can be rendered");
  const auto as_json = std::make_shared<bool>(false);
  list->add_flag("--json", *as_json, "Print JSON");
  AddExamples(*list, {"dataset list", "dataset render demo --out data/demo"});
  list->callback([as_json, &exit_code] { exit_code = *as_json ? PrintListJson() : PrintList(); });
}

}  // namespace cslam
