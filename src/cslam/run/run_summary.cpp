// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/run_summary.h"

#include "cslam/util/text_table.h"

#include <fmt/format.h>

#include <numbers>

namespace cslam {
namespace {

constexpr double kBytesPerMb = 1e6;
constexpr double kBytesPerKb = 1e3;

std::string FrameText(const FrameCounts& frames) {
  std::string text = fmt::format("{}", frames.input);
  if (frames.unreadable > 0) text += fmt::format(", {} unreadable", frames.unreadable);
  if (frames.dropped > 0) text += fmt::format(", {} dropped", frames.dropped);
  const std::size_t lost = frames.recently_lost + frames.lost;
  if (lost > 0) text += fmt::format(", {} lost", lost);
  return text;
}

std::string TrackedText(const RunReport& report) {
  const FrameCounts& frames = report.frames;
  std::string text = fmt::format("{:.1f} % ({} of {})", frames.TrackedPercent(),
                                 frames.in_trajectory, frames.input);
  if (report.map.num_maps > 1) {
    text += fmt::format(", in the largest of {} maps", report.map.num_maps);
  }
  return text;
}

std::string AteText(const AteResult& ate) {
  return fmt::format("{:.4f} m rmse, {:.4f} m max over {} of {} poses", ate.statistics_m.rmse,
                     ate.statistics_m.max, ate.association.pairs.size(),
                     ate.association.num_estimate);
}

std::string RpeText(const RpeResult& rpe) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  return fmt::format("{:.4f} m, {:.3f} deg rmse a frame, {:.4f} m max", rpe.translation_m.rmse,
                     rpe.rotation_rad.rmse * kDegrees, rpe.translation_m.max);
}

void AddAccuracy(const RunAccuracy& accuracy, TextTable& table) {
  if (accuracy.final_poses.ate) table.AddRow({"ATE", AteText(*accuracy.final_poses.ate)});
  if (accuracy.live_poses.ate) table.AddRow({"ATE, live", AteText(*accuracy.live_poses.ate)});
  if (accuracy.final_poses.rpe) table.AddRow({"RPE", RpeText(*accuracy.final_poses.rpe)});
}

std::string TimeText(const RunReport& report) {
  return fmt::format("{:.2f} s for {:.2f} s of recording: {:.2f} x real time", report.cost.wall_s,
                     report.recording_s, report.RealTimeFactor());
}

std::string CpuText(const RunReport& report) {
  if (report.frames.processed == 0) return fmt::format("{:.2f} s", report.cost.cpu_s);
  const auto processed = static_cast<double>(report.frames.processed);
  return fmt::format("{:.2f} s, {:.1f} ms a frame, all threads", report.cost.cpu_s,
                     1e3 * report.cost.cpu_s / processed);
}

std::string KeyframeText(const MapCounts& map) {
  if (map.earlier_keyframes == 0) return fmt::format("{}", map.keyframes);
  return fmt::format("{}, {} of them of earlier runs", map.keyframes, map.earlier_keyframes);
}

std::string ResultTable(const RunReport& report) {
  TextTable table;
  table.AddRow({"frames", FrameText(report.frames)});
  table.AddRow({"tracked", TrackedText(report)});
  table.AddRow({"keyframes", KeyframeText(report.map)});
  table.AddRow({"points", fmt::format("{}", report.map.points)});
  AddAccuracy(report.accuracy, table);
  table.AddRow({"path length", fmt::format("{:.2f} m", report.path_length_m)});
  table.AddRow({"time", TimeText(report)});
  table.AddRow({"CPU time", CpuText(report)});
  if (report.first_pose_ms) {
    table.AddRow(
        {"first pose", fmt::format("{:.2f} s after the start", 1e-3 * *report.first_pose_ms)});
  }
  table.AddRow(
      {"memory", fmt::format("{:.0f} MB at most, about {:.0f} kB a keyframe",
                             static_cast<double>(report.cost.peak_memory_bytes) / kBytesPerMb,
                             report.map.mean_keyframe_bytes / kBytesPerKb)});
  table.AddRow({"results", report.identity.folder.string()});
  return table.Text();
}

std::string StageTable(const std::vector<StageSummary>& stages) {
  TextTable table({{"stage [ms]"},
                   {"count", TextAlign::kRight},
                   {"median", TextAlign::kRight},
                   {"p95", TextAlign::kRight},
                   {"CPU median", TextAlign::kRight},
                   {"CPU p95", TextAlign::kRight}});
  for (const StageSummary& stage : stages) {
    const std::size_t dot = stage.name.find('.');
    const std::string name =
        dot == std::string::npos ? stage.name : "  " + stage.name.substr(dot + 1);
    table.AddRow({name, fmt::format("{}", stage.count), fmt::format("{:.2f}", stage.wall.median_ms),
                  fmt::format("{:.2f}", stage.wall.p95_ms),
                  fmt::format("{:.2f}", stage.cpu.median_ms),
                  fmt::format("{:.2f}", stage.cpu.p95_ms)});
  }
  return table.Text();
}

}  // namespace

std::string FormatRunSummary(const RunReport& report) {
  return ResultTable(report) + "\n" + StageTable(report.stages);
}

}  // namespace cslam
