// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/structure_refinement.h"

#include "cslam/mapping/ba_problem.h"

#include <set>
#include <vector>

namespace cslam {

int RefineStructure(Map& map, std::span<const PointId> points, const Camera& camera,
                    const DepthOptions& depth, const MeasurementModel& model,
                    const BundleAdjusterOptions& options) {
  std::set<KeyframeId> observers;
  for (const PointId id : points) {
    for (const PointObservation& o : map.FindPoint(id)->observations)
      observers.insert(o.keyframe);
  }
  if (observers.empty()) return 0;
  const std::vector<KeyframeId> keyframes(observers.begin(), observers.end());
  const std::vector<PointId> adjusted(points.begin(), points.end());
  BaProblem problem = MakeBaProblem(map, keyframes, adjusted, camera, depth, model);
  problem.pose_is_fixed.assign(keyframes.size(), 1);
  const BaResult result = AdjustBundle(problem, options, {});

  int removed = 0;
  for (std::size_t i = 0; i < problem.observations.size(); ++i) {
    if (result.is_outlier[i] == 0) continue;
    const BaObservation& o = problem.observations[i];
    map.RemoveObservation(adjusted[static_cast<std::size_t>(o.point)],
                          keyframes[static_cast<std::size_t>(o.pose)]);
    ++removed;
  }
  for (std::size_t i = 0; i < adjusted.size(); ++i) {
    if (map.FindPoint(adjusted[i]) == nullptr) continue;  // lost its last observation
    map.SetPosition(adjusted[i], result.p_world[i]);
    map.RefreshGeometry(adjusted[i]);
  }
  return removed;
}

}  // namespace cslam
