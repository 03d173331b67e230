// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/run_json.h"

#include "cslam/run/json_object.h"

#include <numbers>

namespace cslam {
namespace {

JsonObject ToJson(const CameraConfig& config) {
  const Camera& camera = config.camera;
  JsonObject json;
  json.Add("name", config.name);
  json.Add("chosen_by", config.source);
  json.Add("is_approximate", config.approximate);
  json.Add("width_px", camera.width);
  json.Add("height_px", camera.height);
  json.Add("fx_px", camera.fx);
  json.Add("fy_px", camera.fy);
  json.Add("cx_px", camera.cx);
  json.Add("cy_px", camera.cy);
  json.Add("k1", camera.k1);
  json.Add("k2", camera.k2);
  json.Add("p1", camera.p1);
  json.Add("p2", camera.p2);
  json.Add("k3", camera.k3);
  json.Add("depth_units_per_m", config.depth_units_per_m);
  return json;
}

JsonObject ToJson(const HostInfo& host) {
  JsonObject json;
  json.Add("name", host.name);
  json.Add("system", host.system);
  json.Add("cpu", host.cpu);
  json.Add("num_cpus", host.num_cpus);
  return json;
}

JsonObject ToJson(const DetectorInfo& detector) {
  JsonObject json;
  json.Add("kind", detector.kind);
  json.Add("name", detector.name);
  json.Add("source", detector.source);
  return json;
}

JsonObject ToJson(const FrameCounts& frames) {
  JsonObject json;
  json.Add("input", frames.input);
  json.Add("unreadable", frames.unreadable);
  json.Add("dropped", frames.dropped);
  json.Add("processed", frames.processed);
  json.Add("initialising", frames.initialising);
  json.Add("tracking", frames.tracking);
  json.Add("recently_lost", frames.recently_lost);
  json.Add("lost", frames.lost);
  json.Add("in_trajectory", frames.in_trajectory);
  json.Add("tracked_percent", frames.TrackedPercent());
  return json;
}

JsonObject MapToJson(const RunReport& report) {
  const MappingCounts& mapping = report.mapping;
  JsonObject json;
  json.Add("num_maps", report.map.num_maps);
  json.Add("keyframes", report.map.keyframes);
  json.Add("earlier_keyframes", report.map.earlier_keyframes);
  json.Add("points", report.map.points);
  json.Add("keyframes_inserted", mapping.keyframes_inserted);
  json.Add("keyframes_refused", mapping.keyframes_refused);
  json.Add("keyframes_culled", mapping.keyframes_culled);
  json.Add("points_created", mapping.points_created);
  json.Add("points_fused", mapping.points_fused);
  json.Add("points_culled", mapping.points_culled);
  json.Add("ba_runs", mapping.ba_runs);
  json.Add("ba_iterations", mapping.ba_iterations);
  json.Add("ba_stopped", mapping.ba_stopped);
  json.Add("path_length_m", report.path_length_m);
  return json;
}

JsonObject CostToJson(const RunReport& report) {
  const RunCost& cost = report.cost;
  const auto processed = static_cast<double>(report.frames.processed);
  JsonObject json;
  json.Add("recording_s", report.recording_s);
  json.Add("wall_s", cost.wall_s);
  json.Add("real_time_factor", report.RealTimeFactor());
  json.Add("cpu_s", cost.cpu_s);
  json.Add("cpu_ms_per_frame",
           processed > 0.0 ? std::optional(1e3 * cost.cpu_s / processed) : std::nullopt);
  json.Add("first_pose_ms", report.first_pose_ms);
  json.Add("peak_memory_bytes", cost.peak_memory_bytes);
  json.Add("mean_keyframe_bytes", report.map.mean_keyframe_bytes);
  return json;
}

JsonObject ToJson(const TimeSummary& times) {
  JsonObject json;
  json.Add("median_ms", times.median_ms);
  json.Add("p95_ms", times.p95_ms);
  json.Add("p99_ms", times.p99_ms);
  json.Add("max_ms", times.max_ms);
  json.Add("total_ms", times.total_ms);
  return json;
}

JsonObject ToJson(const std::vector<StageSummary>& stages) {
  JsonObject json;
  for (const StageSummary& stage : stages) {
    JsonObject times;
    times.Add("count", stage.count);
    times.Add("wall", ToJson(stage.wall));
    times.Add("cpu", ToJson(stage.cpu));
    json.Add(stage.name, times);
  }
  return json;
}

JsonObject ToJson(const ErrorStatistics& statistics, double unit) {
  JsonObject json;
  json.Add("rmse", statistics.rmse * unit);
  json.Add("mean", statistics.mean * unit);
  json.Add("median", statistics.median * unit);
  json.Add("std", statistics.std * unit);
  json.Add("max", statistics.max * unit);
  return json;
}

JsonObject ToJson(const TrajectoryAccuracy& accuracy) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  JsonObject json;
  if (accuracy.ate) {
    json.Add("ate_m", ToJson(accuracy.ate->statistics_m, 1.0));
    json.Add("ate_poses", accuracy.ate->association.pairs.size());
  }
  if (accuracy.rpe) {
    json.Add("rpe_m", ToJson(accuracy.rpe->translation_m, 1.0));
    json.Add("rpe_deg", ToJson(accuracy.rpe->rotation_rad, kDegrees));
    json.Add("rpe_motions", accuracy.rpe->errors.size());
  }
  return json;
}

// null without ground truth.
std::optional<JsonObject> ToJson(const RunAccuracy& accuracy) {
  if (accuracy.ate_reference.empty()) return std::nullopt;
  JsonObject json;
  json.Add("ate_reference", accuracy.ate_reference);
  json.Add("rpe_reference", accuracy.rpe_reference);
  json.Add("trajectory", ToJson(accuracy.final_poses));
  json.Add("trajectory_live", ToJson(accuracy.live_poses));
  json.Add("problems", accuracy.problems);
  return json;
}

}  // namespace

std::string FormatRunJson(const RunReport& report) {
  const RunIdentity& identity = report.identity;
  JsonObject json;
  json.Add("version", identity.version);
  json.Add("commit", identity.commit);
  json.Add("arguments", identity.arguments);
  json.Add("sequence", identity.sequence.string());
  json.Add("is_deterministic", identity.settings.execution == Execution::kInline);
  json.Add("rate", ToString(identity.settings.rate));
  json.Add("detector", ToJson(identity.detector));
  json.Add("schedule", identity.schedule);
  json.Add("mode", identity.settings.mode == TrackingMode::kMapping ? "mapping" : "localise_only");
  const auto path_or_null = [](const std::filesystem::path& path) {
    return path.empty() ? std::nullopt : std::optional(path.string());
  };
  json.Add("map_file", path_or_null(identity.map));
  json.Add("saved_map_file", path_or_null(identity.save_map));
  json.AddNull("seed");  // nothing is random so far
  json.Add("was_interrupted", report.was_interrupted);
  json.Add("camera", ToJson(report.camera));
  json.Add("host", ToJson(report.host));
  json.Add("frames", ToJson(report.frames));
  json.Add("frame_problems", report.frame_problems);
  json.Add("map", MapToJson(report));
  json.Add("cost", CostToJson(report));
  json.Add("stages", ToJson(report.stages));
  json.Add("accuracy", ToJson(report.accuracy));
  return json.Text() + "\n";
}

}  // namespace cslam
