// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/scene_eval/loop_eval.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace cslam {
namespace {

std::optional<Se3> PoseAt(const Trajectory& truth, Stamp stamp, double max_gap_s) {
  const auto distance_s = [&](Trajectory::const_iterator pose) {
    return std::abs(SecondsBetween(pose->stamp, stamp));
  };
  auto nearest =
      std::lower_bound(truth.begin(), truth.end(), stamp,
                       [](const StampedPose& pose, Stamp wanted) { return pose.stamp < wanted; });
  const bool has_before = nearest != truth.begin();
  if (has_before &&
      (nearest == truth.end() || distance_s(std::prev(nearest)) <= distance_s(nearest)))
    --nearest;
  if (nearest == truth.end() || distance_s(nearest) > max_gap_s) return std::nullopt;
  return nearest->T_world_camera;
}

}  // namespace

LoopEvaluation EvaluateLoops(const Trajectory& truth, const std::vector<AcceptedLoop>& loops,
                             const LoopEvalOptions& options) {
  constexpr double kDegPerRad = 180.0 / std::numbers::pi;
  LoopEvaluation evaluation;
  for (const AcceptedLoop& loop : loops) {
    const std::optional<Se3> query = PoseAt(truth, loop.query, options.max_stamp_gap_s);
    const std::optional<Se3> match = PoseAt(truth, loop.match, options.max_stamp_gap_s);
    if (!query || !match) {
      ++evaluation.num_without_truth;
      continue;
    }
    const PoseDifference error = Difference(match->Inverse() * *query, loop.T_match_query);
    JudgedLoop judged{
        .loop = loop, .error_m = error.distance_m, .error_deg = error.angle_rad * kDegPerRad};
    judged.is_false =
        judged.error_m > options.max_error_m || judged.error_deg > options.max_error_deg;
    evaluation.num_false += judged.is_false ? 1 : 0;
    evaluation.loops.push_back(judged);
  }
  return evaluation;
}

}  // namespace cslam
