// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cmd_render.h"

#include "cslam/dataset/sequence_writer.h"
#include "cslam/util/options.h"
#include "cslam/util/text_table.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <opencv2/core/utility.hpp>

#include <sched.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "cli_common.h"
#include "exit_codes.h"
#include "interrupt.h"
#include "progress_bar.h"

namespace cslam {
namespace {

namespace fs = std::filesystem;

// What can be rendered by name.
struct Story {
  const char* name;
  const char* summary;
  double duration_s;
  SimulatedSequence (*make)(const SequenceOptions&);
};
constexpr std::array kStories{
    Story{"demo", "hand-held tour of a furnished room: 8 m, a full turn, nothing moves", 20.0,
          MakeDemoSequence},
};

// All that WriteSequence() leaves in a folder.
constexpr std::array kSequenceEntries{
    "rgb", "depth", "rgb.txt", "depth.txt", "associations.txt", "groundtruth.txt", "camera.yaml"};

constexpr int kMinSizePx = 32;
constexpr int kMaxSizePx = 4096;

struct RenderArguments {
  std::string name;
  std::string folder;
  SequenceOptions sequence;
  int jobs = 0;  // 0: one for each core
  bool force = false;
};

const Story& FindStory(std::string_view name) {
  std::vector<std::string> names;
  for (const Story& story : kStories) {
    if (name == story.name) return story;
    names.emplace_back(story.name);
  }
  const std::string nearest = NearestName(name, names);
  throw UsageError(fmt::format("unknown sequence '{}'{} (see 'changing-slam dataset list')", name,
                               nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
}

// Frames from the start to the end of the camera's path.
int NumPathFrames(const Story& story, double fps) {
  return std::max(1, static_cast<int>(story.duration_s * fps + 1e-9));
}

int NumCores() {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  if (sched_getaffinity(0, sizeof cores, &cores) != 0) return 1;
  return std::max(1, CPU_COUNT(&cores));
}

std::string Bytes(double bytes) {
  constexpr double kMega = 1e6;
  constexpr double kGiga = 1e9;
  if (bytes >= kGiga) return fmt::format("{:.1f} GB", bytes / kGiga);
  if (bytes >= kMega) return fmt::format("{:.0f} MB", bytes / kMega);
  return fmt::format("{:.0f} kB", std::max(1.0, bytes / 1e3));
}

// Measured on the demo room from 64x48 to 1280x960, within 10 %.
double EstimatedBytes(const SequenceOptions& options, int num_frames) {
  const double bytes_per_pixel = options.noise != SensorNoise::kOff ? 2.5 : 1.8;
  constexpr double kBytesPerFrame = 4000.0;  // small images compress less
  return num_frames *
         (kBytesPerFrame + bytes_per_pixel * static_cast<double>(options.width) * options.height);
}

// Free space where folder is or will be; nothing if the system does not tell.
std::optional<double> FreeBytes(const fs::path& folder) {
  std::error_code error;
  fs::path existing = fs::absolute(folder, error);
  while (!existing.empty() && !fs::exists(existing, error) && existing != existing.root_path())
    existing = existing.parent_path();
  const fs::space_info space = fs::space(existing, error);
  if (error) return std::nullopt;
  return static_cast<double>(space.available);
}

void CheckFreeSpace(const fs::path& folder, double needed_bytes) {
  const std::optional<double> free_bytes = FreeBytes(folder);
  if (free_bytes && *free_bytes < needed_bytes) {
    throw Error(
        "'{}' has {} free, and the sequence needs about {}; choose another folder, or "
        "fewer or smaller frames",
        folder.string(), Bytes(*free_bytes), Bytes(needed_bytes));
  }
}

void RemoveSequence(const fs::path& folder) {
  for (const char* entry : kSequenceEntries) {
    std::error_code error;
    fs::remove_all(folder / entry, error);
    if (error) throw Error("cannot remove '{}': {}", (folder / entry).string(), error.message());
  }
}

// --force replaces a sequence and never touches anything else.
void CheckHoldsOnlySequence(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (std::find(kSequenceEntries.begin(), kSequenceEntries.end(), name) ==
        kSequenceEntries.end()) {
      throw Error(
          "'{}' holds '{}', which is not part of a rendered sequence; choose another folder",
          folder.string(), name);
    }
  }
}

void ClearFolder(const RenderArguments& arguments) {
  const fs::path folder = arguments.folder;
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (!fs::is_directory(folder, error))
    throw Error("'{}' is not a folder; choose another name", folder.string());
  if (fs::is_empty(folder)) return;
  if (!arguments.force) {
    throw Error("'{}' is not empty; choose another folder, or replace the sequence with --force",
                folder.string());
  }
  CheckHoldsOnlySequence(folder);
  RemoveSequence(folder);
}

WriteOutcome Write(const SimulatedSequence& sequence, const RenderArguments& arguments) {
  ProgressBar bar("rendering", sequence.size());
  std::stop_source stop;
  WriteSequenceOptions options;
  options.jobs = arguments.jobs > 0 ? arguments.jobs : NumCores();
  options.stop = stop.get_token();
  options.progress = [&](int done, int /*total*/) {
    bar.Update(done);
    if (InterruptRequested()) stop.request_stop();
  };
  return WriteSequence(sequence, arguments.folder, options);
}

// An incomplete sequence is of no use and might be taken for a complete one.
WriteOutcome WriteOrRemove(const SimulatedSequence& sequence, const RenderArguments& arguments) {
  try {
    const WriteOutcome outcome = Write(sequence, arguments);
    if (outcome == WriteOutcome::kStopped) RemoveSequence(arguments.folder);
    return outcome;
  } catch (const Error&) {
    RemoveSequence(arguments.folder);
    throw;
  }
}

int RunRender(const RenderArguments& arguments) {
  const Story& story = FindStory(arguments.name);
  const SequenceOptions& options = arguments.sequence;
  const int num_path_frames = NumPathFrames(story, options.fps);
  const int num_frames = options.num_frames > 0 ? options.num_frames : num_path_frames;
  const double needed_bytes = EstimatedBytes(options, num_frames);
  ClearFolder(arguments);
  CheckFreeSpace(arguments.folder, needed_bytes);
  fmt::print(stderr, "'{}': {} frame{} of {}x{} at {} Hz, about {} in '{}'\n", story.name,
             num_frames, num_frames == 1 ? "" : "s", options.width, options.height, options.fps,
             Bytes(needed_bytes), arguments.folder);
  if (num_frames > num_path_frames) {
    fmt::print(stderr, "warning: the camera rests after {} s, the end of its path\n",
               story.duration_s);
  }
  CatchInterrupts();
  cv::setNumThreads(1);  // the frames are spread over the cores already
  if (WriteOrRemove(story.make(options), arguments) == WriteOutcome::kStopped) {
    fmt::print(stderr, "interrupted; the incomplete sequence is removed\n");
    return kExitInterrupted;
  }
  return kExitOk;
}

int RunList() {
  TextTable table({{"name"}, {"length", TextAlign::kRight}, {"what"}});
  for (const Story& story : kStories)
    table.AddRow({story.name, fmt::format("{} s", story.duration_s), story.summary});
  fmt::print("{}", table.Text());
  return kExitOk;
}

// "640x480" -> width and height; throws what CLI11 reports as a usage error.
void ParseSize(const std::string& text, SequenceOptions& options) {
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
  options.width = width;
  options.height = height;
}

// The range check of CLI11 lets "nan" pass. Empty: nothing to object to.
std::string WhyNotFinite(const std::string& text) {
  double value = 0.0;
  const bool is_number = CLI::detail::lexical_cast(text, value);
  return is_number && std::isfinite(value) ? "" : fmt::format("'{}' is not a number", text);
}

// Conversion to an unsigned number would wrap it around.
std::string WhyNegative(const std::string& text) {
  return text.starts_with("-") ? fmt::format("'{}' is negative", text) : "";
}

void AddRender(CLI::App& dataset, int& exit_code) {
  CLI::App* const app = dataset.add_subcommand(
      "render",
      "Render a sequence with ground truth (TUM layout); the files depend on its "
      "options alone, not on the number of jobs");
  const auto arguments = std::make_shared<RenderArguments>();
  SequenceOptions& sequence = arguments->sequence;
  app->add_option("name", arguments->name, "Which one; 'dataset list' names all")->required();
  app->add_option("--out", arguments->folder, "New or empty folder")->type_name("DIR")->required();
  app->add_option("--frames", sequence.num_frames, "Stop after so many; the whole path unless told")
      ->check(CLI::Range(1, 1'000'000));
  app->add_option("--fps", sequence.fps, "Frames per second; the camera moves the same way")
      ->check(CLI::Range(0.1, 1000.0) & CLI::Validator(WhyNotFinite, "", "finite"))
      ->capture_default_str();
  app->add_option_function<std::string>(
         "--size", [&sequence](const std::string& text) { ParseSize(text, sequence); },
         "Size of the images (640x480 unless told)")
      ->type_name("WxH");
  app->add_option_function<std::string>(
         "--noise",
         [&sequence](const std::string& noise) {
           sequence.noise = noise == "kinect" ? SensorNoise::kKinect : SensorNoise::kOff;
         },
         "kinect: depth and colour as such a sensor gives them (unless told); off: exact")
      ->check(CLI::IsMember({"off", "kinect"}));
  app->add_option("--seed", sequence.seed, "Another room, wobble and noise for each")
      ->check(CLI::Validator(WhyNegative, "", "not negative"))
      ->capture_default_str();
  app->add_option("--jobs", arguments->jobs, "Threads; one for each core unless told")
      ->check(CLI::Range(1, 256));
  app->add_flag("--force", arguments->force, "Replace the sequence that is in the folder");
  AddExamples(*app, {"dataset render demo --out data/demo",
                     "dataset render demo --out data/small --size 320x240 --fps 15 --noise off"});
  app->callback([arguments, &exit_code] { exit_code = RunRender(*arguments); });
}

}  // namespace

void AddRenderCommands(CLI::App& dataset, int& exit_code) {
  AddRender(dataset, exit_code);
  CLI::App* const list = dataset.add_subcommand("list", "Name the sequences that can be rendered");
  AddExamples(*list, {"dataset list", "dataset render demo --out data/demo"});
  list->callback([&exit_code] { exit_code = RunList(); });
}

}  // namespace cslam
