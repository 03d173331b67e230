// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/run_log.h"

#include "cslam/run/process_info.h"

namespace cslam {
namespace {

std::size_t Count(int number) {
  return static_cast<std::size_t>(number);
}

}  // namespace

void RunRecorder::OnFrame(const TrackingResult& result) {
  if (result.T_world_camera && !log_.first_pose_ms) log_.first_pose_ms = ProcessAgeMs();
  log_.frames.push_back(result);
}

void RunRecorder::OnMap(const MapUpdate& update) {
  MappingCounts& counts = log_.mapping;
  switch (update.step) {
    case MapUpdate::Step::kInserted:
      ++counts.keyframes_inserted;
      log_.mapper_steps.emplace_back();
      break;
    case MapUpdate::Step::kRefined:
      ++counts.ba_runs;
      if (update.ba_was_stopped) ++counts.ba_stopped;
      break;
    case MapUpdate::Step::kCorrected:
      break;
    case MapUpdate::Step::kContinued:
      return;
    case MapUpdate::Step::kRefused:
      ++counts.keyframes_refused;
      return;
  }
  counts.points_created += Count(update.points_created);
  counts.points_fused += Count(update.points_fused);
  counts.points_culled += Count(update.points_culled);
  counts.keyframes_culled += Count(update.keyframes_culled);
  counts.ba_iterations += Count(update.ba_iterations);
  if (log_.mapper_steps.empty()) log_.mapper_steps.emplace_back();
  auto& times = log_.mapper_steps.back();
  times.insert(times.end(), update.times.begin(), update.times.end());
}

}  // namespace cslam
