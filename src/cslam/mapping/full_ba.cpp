// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/full_ba.h"

#include "cslam/mapping/ba_problem.h"
#include "cslam/util/options.h"

#include <algorithm>
#include <vector>

namespace cslam {
namespace {

struct Selection {
  std::vector<KeyframeId> keyframes;
  std::vector<PointId> points;
};

Selection Select(const MapView& map, MapId id, int min_observations) {
  Selection selection;
  for (const KeyframeId keyframe : map.Keyframes()) {
    if (map.FindKeyframe(keyframe)->map == id) selection.keyframes.push_back(keyframe);
  }
  selection.points = PointsSeenBy(map, selection.keyframes);
  std::erase_if(selection.points, [&](PointId point) {
    return static_cast<int>(map.FindPoint(point)->observations.size()) < min_observations;
  });
  std::sort(selection.points.begin(), selection.points.end());
  return selection;
}

PoseRefinement MakeRefinement(const MapView& map, MapId id, const Selection& selection,
                              const BaProblem& problem, const BaResult& result) {
  PoseRefinement refinement;
  refinement.epoch = map.correction_epoch();
  refinement.map = id;
  refinement.iterations = result.iterations;
  for (std::size_t i = 0; i < selection.keyframes.size(); ++i) {
    refinement.poses.push_back(
        {selection.keyframes[i], problem.T_world_camera[i], result.T_world_camera[i]});
  }
  for (std::size_t i = 0; i < selection.points.size(); ++i)
    refinement.positions.push_back({selection.points[i], problem.p_world[i], result.p_world[i]});
  for (std::size_t i = 0; i < problem.observations.size(); ++i) {
    if (result.is_outlier[i] == 0) continue;
    const BaObservation& o = problem.observations[i];
    refinement.outliers.push_back({selection.points[static_cast<std::size_t>(o.point)],
                                   selection.keyframes[static_cast<std::size_t>(o.pose)]});
  }
  return refinement;
}

}  // namespace

void Describe(OptionList& list, FullBaOptions& o) {
  list.Group("solver", o.solver);
  list.Add("min_observations", o.min_observations, {1, 100}, "keyframes",
           "Points seen by fewer keyframes take no part; they move with their keyframe.");
}

std::optional<PoseRefinement> AdjustFully(const MapView& map, MapId id, const Camera& camera,
                                          const DepthOptions& depth, const MeasurementModel& model,
                                          const FullBaOptions& options,
                                          const std::function<bool()>& should_stop) {
  const Selection selection = Select(map, id, options.min_observations);
  if (selection.keyframes.size() < 2) return std::nullopt;
  BaProblem problem =
      MakeBaProblem(map, selection.keyframes, selection.points, camera, depth, model);
  for (std::size_t i = 0; i < selection.keyframes.size(); ++i) {
    const bool is_root = !map.FindKeyframe(selection.keyframes[i])->parent.valid();
    problem.pose_is_fixed[i] = is_root ? 1 : 0;
  }
  const BaResult result = AdjustBundle(problem, options.solver, should_stop);
  if (result.was_stopped) return std::nullopt;
  return MakeRefinement(map, id, selection, problem, result);
}

}  // namespace cslam
