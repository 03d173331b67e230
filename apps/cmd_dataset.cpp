// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cmd_dataset.h"

#include "cslam/dataset/sequence_check.h"
#include "cslam/io/dataset_info.h"
#include "cslam/util/text_table.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "check_text.h"
#include "cli_common.h"
#include "cmd_render.h"
#include "exit_codes.h"

namespace cslam {
namespace {

using Json = nlohmann::ordered_json;

struct DatasetArguments {
  std::string folder;
  CameraChoice camera;
  std::optional<std::size_t> num_samples;
  bool as_json = false;
};

std::string Percent(double share) {
  return fmt::format("{:.1f} %", 100.0 * share);
}

std::string GapsText(const std::vector<FrameGap>& gaps) {
  if (gaps.empty()) return fmt::format("none over {} s", kLongGapS);
  const FrameGap longest = *std::max_element(
      gaps.begin(), gaps.end(),
      [](const FrameGap& a, const FrameGap& b) { return a.length_s < b.length_s; });
  return fmt::format("{} over {} s, the longest {:.3f} s after frame {}", gaps.size(), kLongGapS,
                     longest.length_s, longest.frame);
}

std::string CameraText(const DatasetInfo& info) {
  if (!info.camera) return "unknown (pass --camera)";
  const CameraConfig& config = *info.camera;
  return fmt::format("{}{}, {}x{}; {}", config.name, config.approximate ? " (approximate)" : "",
                     config.camera.width, config.camera.height, config.source);
}

std::string GroundTruthText(const DatasetInfo& info) {
  if (!info.ground_truth) return "no";
  const GroundTruthInfo& truth = *info.ground_truth;
  if (!truth.problem.empty()) return "unusable: " + truth.problem;
  return fmt::format("{}: {} poses, {:.2f} m over the {} of {} frames it covers",
                     truth.path.filename().string(), truth.num_poses, truth.path_length_m,
                     truth.num_covered_frames, info.num_frames);
}

std::string FormatInfo(const DatasetInfo& info) {
  TextTable table;
  table.AddRow({"folder", info.folder.string()});
  table.AddRow({"frames", fmt::format("{}, from {}", info.num_frames, info.pair_source)});
  table.AddRow({"without partner", fmt::format("{} colour, {} depth", info.num_unmatched_color,
                                               info.num_unmatched_depth)});
  table.AddRow({"duration",
                fmt::format("{:.3f} s from {}", info.duration_s, FormatStamp(info.first_stamp))});
  table.AddRow({"rate", fmt::format("{:.1f} Hz", info.rate_hz)});
  table.AddRow({"pauses", GapsText(info.gaps)});
  table.AddRow({"colour to depth",
                fmt::format("{:.1f} ms apart, at most {:.1f} ms", 1e3 * info.mean_pair_difference_s,
                            1e3 * info.max_pair_difference_s)});
  table.AddRow(
      {"images", fmt::format("{}x{} {}", info.width_px, info.height_px, info.color_format)});
  table.AddRow({"camera", CameraText(info)});
  if (info.camera) {
    table.AddRow(
        {"depth scale", fmt::format("{} units per metre", info.camera->depth_units_per_m)});
  }
  table.AddRow({"ground truth", GroundTruthText(info)});
  table.AddRow({"depth", fmt::format("{} of the pixels, median {:.2f} m ({} frames looked at)",
                                     Percent(info.depth_valid_share), info.median_depth_m,
                                     info.num_sampled - info.num_unreadable)});
  return table.Text();
}

Json CameraJson(const std::optional<CameraConfig>& config) {
  if (!config) return nullptr;
  const Camera& c = config->camera;
  return {{"name", config->name},
          {"source", config->source},
          {"approximate", config->approximate},
          {"width_px", c.width},
          {"height_px", c.height},
          {"fx_px", c.fx},
          {"fy_px", c.fy},
          {"cx_px", c.cx},
          {"cy_px", c.cy},
          {"distortion_k1_k2_p1_p2_k3", {c.k1, c.k2, c.p1, c.p2, c.k3}},
          {"depth_units_per_m", config->depth_units_per_m}};
}

Json GroundTruthJson(const std::optional<GroundTruthInfo>& truth) {
  if (!truth) return nullptr;
  return {{"file", truth->path.string()},
          {"poses", truth->num_poses},
          {"path_length_m", truth->path_length_m},
          {"covered_frames", truth->num_covered_frames},
          {"problem", truth->problem}};
}

std::string FormatInfoJson(const DatasetInfo& info) {
  Json gaps = Json::array();
  for (const FrameGap& gap : info.gaps)
    gaps.push_back({{"after_frame", gap.frame}, {"length_s", gap.length_s}});
  const Json json{{"folder", info.folder.string()},
                  {"pair_source", info.pair_source},
                  {"frames", info.num_frames},
                  {"unmatched_color", info.num_unmatched_color},
                  {"unmatched_depth", info.num_unmatched_depth},
                  {"first_stamp", FormatStamp(info.first_stamp)},
                  {"duration_s", info.duration_s},
                  {"rate_hz", info.rate_hz},
                  {"gaps", gaps},
                  {"mean_pair_difference_s", info.mean_pair_difference_s},
                  {"max_pair_difference_s", info.max_pair_difference_s},
                  {"image_width_px", info.width_px},
                  {"image_height_px", info.height_px},
                  {"camera", CameraJson(info.camera)},
                  {"ground_truth", GroundTruthJson(info.ground_truth)},
                  {"sampled_frames", info.num_sampled},
                  {"unreadable_sampled_frames", info.num_unreadable},
                  {"depth_valid_share", info.depth_valid_share},
                  {"median_depth_m", info.median_depth_m}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

int RunInfo(const DatasetArguments& arguments) {
  constexpr std::size_t kDefaultSamples = 20;
  const DatasetInfo info = InspectDataset(arguments.folder, arguments.camera,
                                          arguments.num_samples.value_or(kDefaultSamples));
  if (!info.camera) fmt::print(stderr, "warning: {}\n", info.camera_problem);
  if (info.num_unreadable > 0) {
    fmt::print(stderr, "warning: {} of {} frames looked at cannot be used; the first: {}\n",
               info.num_unreadable, info.num_sampled, info.first_problem);
  }
  fmt::print("{}", arguments.as_json ? FormatInfoJson(info) : FormatInfo(info));
  return kExitOk;
}

int RunCheck(const DatasetArguments& arguments) {
  const SequenceCheck check = CheckSequence(
      arguments.folder, {.camera = arguments.camera, .num_samples = arguments.num_samples});
  fmt::print("{}", arguments.as_json ? FormatCheckJson(check) : FormatCheck(check));
  return check.errors.empty() ? kExitOk : kExitRuntimeError;
}

std::shared_ptr<DatasetArguments> AddArguments(CLI::App& app, const char* sample_help) {
  auto arguments = std::make_shared<DatasetArguments>();
  app.add_option("path", arguments->folder, "Folder of the sequence")
      ->type_name("FOLDER")
      ->required();
  app.add_option("--camera", arguments->camera.camera,
                 "Camera: a file, or one of " + DescribeCameraPresets())
      ->type_name("NAME|FILE");
  app.add_option("--depth-scale", arguments->camera.depth_units_per_m,
                 "Depth image units per metre; overrides that of the camera");
  app.add_option("--sample", arguments->num_samples, sample_help)->check(CLI::Range(1, 1'000'000));
  app.add_flag("--json", arguments->as_json, "Print JSON");
  return arguments;
}

}  // namespace

CLI::App* AddDatasetCommand(CLI::App& root, int& exit_code) {
  CLI::App* const app = root.add_subcommand("dataset", "Describe, check or render a sequence");
  app->require_subcommand(1);
  AddExamples(*app, {"dataset info ~/data/rgbd_dataset_freiburg1_desk",
                     "dataset check ~/data/rgbd_dataset_freiburg1_desk",
                     "dataset render demo --out data/demo"});

  CLI::App* const info = app->add_subcommand(
      "info", "Tell frames, times, camera, ground truth and depth of a sequence");
  const auto info_arguments =
      AddArguments(*info, "How many frames to decode, evenly spread (20 unless told)");
  AddExamples(*info, {"dataset info ~/data/rgbd_dataset_freiburg1_desk",
                      "dataset info my_recording --camera my_camera.yaml --json"});
  info->callback([info_arguments, &exit_code] { exit_code = RunInfo(*info_arguments); });

  CLI::App* const check = app->add_subcommand(
      "check",
      "Look at files, depth against poses, truth files and story, and list what is "
      "wrong; exit code 1 if something is");
  const auto check_arguments = AddArguments(
      *check, "Look at the images of so many frames only, evenly spread; all unless told");
  AddExamples(*check, {"dataset check ~/data/rgbd_dataset_freiburg1_desk",
                       "dataset check my_recording --camera d435i --sample 50"});
  check->callback([check_arguments, &exit_code] { exit_code = RunCheck(*check_arguments); });

  AddRenderCommands(*app, exit_code);
  return app;
}

}  // namespace cslam
