// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/run_report.h"

#include <algorithm>
#include <set>
#include <utility>

namespace cslam {
namespace {

FrameCounts CountFrames(const RunOutcome& outcome, std::size_t in_trajectory) {
  FrameCounts counts;
  counts.input = outcome.play.frames_read + outcome.play.frames_unreadable;
  counts.unreadable = outcome.play.frames_unreadable;
  counts.dropped = outcome.result.frames_dropped;
  counts.processed = outcome.result.frames.size();
  counts.in_trajectory = in_trajectory;
  for (const FrameRecord& frame : outcome.result.frames) {
    switch (frame.state) {
      case TrackingState::kInitialising:
        ++counts.initialising;
        break;
      case TrackingState::kTracking:
        ++counts.tracking;
        break;
      case TrackingState::kRecentlyLost:
        ++counts.recently_lost;
        break;
      case TrackingState::kLost:
        ++counts.lost;
        break;
    }
  }
  return counts;
}

template <typename T>
std::size_t BytesOf(const std::vector<T>& values) {
  return values.capacity() * sizeof(T);
}

std::size_t BytesOf(const cv::Mat& image) {
  return image.total() * image.elemSize();
}

std::size_t EstimateBytes(const Keyframe& keyframe) {
  const FrameFeatures& features = keyframe.data->features;
  const std::size_t grid_bytes = features.size() * sizeof(std::uint16_t);
  return sizeof(Keyframe) + sizeof(KeyframeData) + BytesOf(features.keypoints) +
         BytesOf(features.descriptors) + BytesOf(features.semantics) + grid_bytes +
         BytesOf(keyframe.data->depth_small_mm) + BytesOf(keyframe.data->bgr_small) +
         BytesOf(keyframe.points) + BytesOf(keyframe.covisible);
}

MapCounts CountMap(const RunResult& result) {
  MapCounts counts;
  const MapId map = LargestMap(result);
  const MapView& view = result.snapshot->map;
  std::set<MapId> maps;
  for (const FrameRecord& frame : result.frames) {
    if (frame.state == TrackingState::kTracking) maps.insert(MapOf(result, frame));
  }
  counts.num_maps = maps.size();
  std::size_t bytes = 0;
  for (const KeyframeId id : view.Keyframes()) {
    const Keyframe& keyframe = *view.FindKeyframe(id);
    if (keyframe.map != map) continue;
    ++counts.keyframes;
    if (!IsOfThisRun(view, id)) ++counts.earlier_keyframes;
    bytes += EstimateBytes(keyframe);
  }
  for (std::size_t i = 0; i < view.num_point_ids(); ++i) {
    const MapPoint* const point = view.FindPoint(PointId(static_cast<std::uint32_t>(i)));
    if (point != nullptr && point->IsActive() && point->map == map) ++counts.points;
  }
  if (counts.keyframes > 0) {
    counts.mean_keyframe_bytes = static_cast<double>(bytes) / static_cast<double>(counts.keyframes);
  }
  return counts;
}

double RecordingSeconds(const PlayReport& play) {
  if (!play.first_stamp) return 0.0;
  return SecondsBetween(*play.last_stamp, *play.first_stamp);
}

}  // namespace

double FrameCounts::TrackedPercent() const {
  if (input == 0) return 0.0;
  return 100.0 * static_cast<double>(in_trajectory) / static_cast<double>(input);
}

double RunReport::RealTimeFactor() const {
  return cost.wall_s > 0.0 ? recording_s / cost.wall_s : 0.0;
}

RunTrajectories ExtractTrajectories(const RunResult& result) {
  return {.final_poses = FinalTrajectory(result),
          .live_poses = LiveTrajectory(result),
          .keyframes = KeyframeTrajectory(result)};
}

RunReport MakeReport(RunIdentity identity, const DatasetReader& dataset, const RunOutcome& outcome,
                     const RunTrajectories& trajectories) {
  RunReport report;
  report.identity = std::move(identity);
  report.camera = dataset.camera();
  report.host = DescribeHost();
  report.was_interrupted = outcome.play.was_interrupted;
  report.frames = CountFrames(outcome, trajectories.final_poses.size());
  report.frame_problems = outcome.play.problems;
  report.map = CountMap(outcome.result);
  report.mapping = outcome.log.mapping;
  if (!outcome.log.frames.empty()) report.last_reason = outcome.log.frames.back().reason;
  report.recording_s = RecordingSeconds(outcome.play);
  report.path_length_m = PathLength(trajectories.final_poses);
  report.cost = outcome.cost;
  report.first_pose_ms = outcome.log.first_pose_ms;
  report.stages = SummariseStages(outcome.log, outcome.play.loads);
  const auto ground_truth = dataset.ground_truth();
  if (ground_truth && !trajectories.final_poses.empty()) {
    report.accuracy =
        MeasureAccuracy(*ground_truth, trajectories.final_poses, trajectories.live_poses);
  }
  return report;
}

}  // namespace cslam
