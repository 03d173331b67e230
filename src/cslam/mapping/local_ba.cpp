// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/local_ba.h"

#include "cslam/mapping/ba_problem.h"

#include <algorithm>
#include <map>
#include <vector>

namespace cslam {
namespace {

// Which keyframes move, which hold still, and which points they see.
struct Selection {
  std::vector<KeyframeId> keyframes;  // the free ones first
  std::size_t num_free = 0;
  std::vector<PointId> points;
};

Selection Select(const Map& map, KeyframeId center, int min_shared_points,
                 const LocalBaOptions& options) {
  Selection selection;
  selection.keyframes.push_back(center);
  const auto neighbours = map.Neighbours(center, min_shared_points,
                                         static_cast<std::size_t>(options.max_keyframes - 1));
  for (const CovisibleKeyframe& n : neighbours)
    selection.keyframes.push_back(n.id);
  selection.num_free = selection.keyframes.size();
  selection.points = PointsSeenBy(map, selection.keyframes);

  std::map<KeyframeId, int> others;
  for (const PointId id : selection.points) {
    for (const PointObservation& o : map.FindPoint(id)->observations)
      ++others[o.keyframe];
  }
  for (const KeyframeId id : selection.keyframes)
    others.erase(id);
  std::vector<CovisibleKeyframe> fixed;
  fixed.reserve(others.size());
  for (const auto& [id, count] : others)
    fixed.push_back({id, count});
  std::stable_sort(fixed.begin(), fixed.end(),
                   [](const auto& a, const auto& b) { return a.shared_points > b.shared_points; });
  const auto max_fixed = static_cast<std::size_t>(options.max_fixed_keyframes);
  if (fixed.size() > max_fixed) fixed.resize(max_fixed);
  for (const CovisibleKeyframe& f : fixed)
    selection.keyframes.push_back(f.id);
  return selection;
}

// Something must hold still: the map's first keyframe if it takes part, else the fixed
// observers, else the oldest of the free ones.
void FixGauge(const Map& map, const Selection& selection, BaProblem& problem) {
  std::size_t oldest = 0;
  for (std::size_t i = 0; i < selection.keyframes.size(); ++i) {
    const bool is_root = !map.FindKeyframe(selection.keyframes[i])->parent.valid();
    if (i >= selection.num_free || is_root) problem.pose_is_fixed[i] = 1;
    if (i < selection.num_free && selection.keyframes[i] < selection.keyframes[oldest]) oldest = i;
  }
  const bool has_fixed = std::count(problem.pose_is_fixed.begin(), problem.pose_is_fixed.end(), 1);
  if (!has_fixed) problem.pose_is_fixed[oldest] = 1;
}

// Points that take no part move with their reference keyframe.
void MoveHeldBack(Map& map, KeyframeId keyframe, const Se3& T_new_old) {
  const std::vector<PointId> points = map.FindKeyframe(keyframe)->points;
  for (const PointId id : points) {
    const MapPoint* point = id.valid() ? map.FindPoint(id) : nullptr;
    if (point == nullptr || !point->is_held_back || point->reference != keyframe) continue;
    map.SetPosition(id, T_new_old * point->p_world);
    map.RefreshGeometry(id);
  }
}

}  // namespace

LocalBaReport AdjustLocally(Map& map, KeyframeId center, const Camera& camera,
                            const DepthOptions& depth, const MeasurementModel& model,
                            int min_shared_points, const LocalBaOptions& options,
                            const std::function<bool()>& should_stop) {
  const Selection selection = Select(map, center, min_shared_points, options);
  BaProblem problem =
      MakeBaProblem(map, selection.keyframes, selection.points, camera, depth, model);
  FixGauge(map, selection, problem);
  const BaResult result = AdjustBundle(problem, options.solver, should_stop);

  for (std::size_t i = 0; i < selection.num_free; ++i) {
    if (problem.pose_is_fixed[i] != 0) continue;
    const KeyframeId id = selection.keyframes[i];
    const Se3 T_new_old = result.T_world_camera[i] * map.FindKeyframe(id)->T_world_camera.Inverse();
    map.SetPose(id, result.T_world_camera[i]);
    MoveHeldBack(map, id, T_new_old);
  }
  LocalBaReport report;
  for (std::size_t i = 0; i < problem.observations.size(); ++i) {
    if (result.is_outlier[i] == 0) continue;
    const BaObservation& o = problem.observations[i];
    map.RemoveObservation(selection.points[static_cast<std::size_t>(o.point)],
                          selection.keyframes[static_cast<std::size_t>(o.pose)]);
    ++report.outliers_removed;
  }
  for (std::size_t i = 0; i < selection.points.size(); ++i) {
    if (map.FindPoint(selection.points[i]) == nullptr) continue;  // lost its last observation
    map.SetPosition(selection.points[i], result.p_world[i]);
    map.RefreshGeometry(selection.points[i]);
  }
  report.num_keyframes = static_cast<int>(selection.num_free);
  report.num_points = static_cast<int>(selection.points.size());
  report.iterations = result.iterations;
  report.was_stopped = result.was_stopped;
  return report;
}

}  // namespace cslam
