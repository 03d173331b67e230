// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/relocalisation_report.h"

#include "cslam/run/pose_json.h"
#include "cslam/run/stage_times.h"
#include "cslam/util/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace cslam {
namespace {

using Frame = RelocalisationReport::Frame;

constexpr double kDegPerRad = 180.0 / std::numbers::pi;

TimeSummary FindTimes(const std::vector<Frame>& frames) {
  std::vector<double> times_ms;
  for (const Frame& frame : frames)
    times_ms.push_back(frame.result.find_ms);
  return SummariseTimes(std::move(times_ms));
}

JsonObject ToJson(const Frame& frame) {
  const LocalisedFrame& result = frame.result;
  JsonObject json;
  json.Add("frame", result.frame.value());
  json.Add("stamp", FormatStamp(result.stamp));
  json.Add("is_found", result.T_world_camera.has_value());
  json.Add("reason", result.reason);
  json.Add("map", result.T_world_camera ? std::optional(result.map.value()) : std::nullopt);
  json.Add("T_world_camera", PoseToJson(result.T_world_camera));
  json.Add("error_m", frame.error ? std::optional(frame.error->distance_m) : std::nullopt);
  json.Add("error_deg",
           frame.error ? std::optional(frame.error->angle_rad * kDegPerRad) : std::nullopt);
  return json;
}

// null without ground truth.
std::optional<JsonObject> ToJson(const RelocalisationErrors& errors) {
  if (errors.count == 0) return std::nullopt;
  JsonObject json;
  json.Add("frames", errors.count);
  json.Add("median_m", errors.median_m);
  json.Add("max_m", errors.max_m);
  json.Add("median_deg", errors.median_deg);
  json.Add("max_deg", errors.max_deg);
  return json;
}

}  // namespace

std::size_t CountFound(const RelocalisationReport& report) {
  return static_cast<std::size_t>(
      std::count_if(report.frames.begin(), report.frames.end(),
                    [](const Frame& f) { return f.result.T_world_camera.has_value(); }));
}

RelocalisationErrors SummariseErrors(const std::vector<Frame>& frames) {
  std::vector<double> errors_m;
  std::vector<double> errors_deg;
  for (const Frame& frame : frames) {
    if (!frame.error) continue;
    errors_m.push_back(frame.error->distance_m);
    errors_deg.push_back(frame.error->angle_rad * kDegPerRad);
  }
  if (errors_m.empty()) return {};
  std::sort(errors_m.begin(), errors_m.end());
  std::sort(errors_deg.begin(), errors_deg.end());
  return {.count = errors_m.size(),
          .median_m = Quantile(errors_m, 0.5),
          .max_m = errors_m.back(),
          .median_deg = Quantile(errors_deg, 0.5),
          .max_deg = errors_deg.back()};
}

std::string FormatRelocalisation(const RelocalisationReport& report) {
  const std::size_t found = CountFound(report);
  const double percent = report.frames.empty() ? 0.0
                                               : 100.0 * static_cast<double>(found) /
                                                     static_cast<double>(report.frames.size());
  TextTable table;
  table.AddRow(
      {"found", fmt::format("{} of {} frames ({:.1f} %)", found, report.frames.size(), percent)});
  if (report.num_unreadable > 0) {
    table.AddRow({"unreadable", fmt::format("{} frames", report.num_unreadable)});
  }
  const RelocalisationErrors errors = SummariseErrors(report.frames);
  if (errors.count > 0) {
    table.AddRow(
        {"error, median", fmt::format("{:.4f} m, {:.3f} deg", errors.median_m, errors.median_deg)});
    table.AddRow(
        {"error, largest", fmt::format("{:.4f} m, {:.3f} deg", errors.max_m, errors.max_deg)});
  }
  if (report.keyframe_rmse_m) {
    table.AddRow({"map's keyframes", fmt::format("{:.4f} m rmse", *report.keyframe_rmse_m)});
  }
  const TimeSummary times = FindTimes(report.frames);
  table.AddRow({"CPU time of a search",
                fmt::format("{:.1f} ms median, {:.1f} ms p95", times.median_ms, times.p95_ms)});
  return table.Text();
}

std::string FormatRelocalisationJson(const RelocalisationReport& report) {
  JsonObject head;
  head.Add("format", "relocalisation");
  head.Add("version", 1);
  head.Add("map_file", report.map.string());
  head.Add("sequence", report.sequence.string());
  head.Add("frames", report.frames.size());
  head.Add("found", CountFound(report));
  head.Add("unreadable", report.num_unreadable);
  head.Add("keyframe_rmse_m", report.keyframe_rmse_m);
  head.Add("errors", ToJson(SummariseErrors(report.frames)));
  std::vector<JsonObject> results;
  for (const Frame& frame : report.frames)
    results.push_back(ToJson(frame));
  std::string text = head.Text();
  text.resize(text.rfind('\n'));  // without the closing brace
  return fmt::format("{},\n  \"results\": [\n{}\n]}}\n", text, JsonItems(results));
}

}  // namespace cslam
