// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/eval/ate.h"

#include "cslam/util/check.h"

#include <cmath>

namespace cslam {
namespace {

Alignment AlignCentres(const std::vector<PosePair>& pairs, AlignmentScale scale) {
  std::vector<Eigen::Vector3d> reference;
  std::vector<Eigen::Vector3d> estimate;
  for (const PosePair& pair : pairs) {
    reference.push_back(pair.reference.translation);
    estimate.push_back(pair.estimate.translation);
  }
  Alignment alignment = AlignPoints(reference, estimate, scale);
  if (!alignment.is_unique) {
    throw Error(
        "{} matched poses do not fix an alignment (fewer than three, or all on one line); use "
        "--align origin or --align none",
        pairs.size());
  }
  return alignment;
}

Alignment AlignFirstPose(const std::vector<PosePair>& pairs) {
  Alignment alignment;
  alignment.T_a_b = pairs.front().reference * pairs.front().estimate.Inverse();
  alignment.num_points = 1;
  alignment.is_unique = true;
  return alignment;
}

Alignment FindAlignment(const std::vector<PosePair>& pairs, TrajectoryAlignment mode) {
  switch (mode) {
    case TrajectoryAlignment::kNone:
      return Alignment{};
    case TrajectoryAlignment::kOrigin:
      return AlignFirstPose(pairs);
    case TrajectoryAlignment::kSe3:
      return AlignCentres(pairs, AlignmentScale::kFixedToOne);
    case TrajectoryAlignment::kSim3:
      return AlignCentres(pairs, AlignmentScale::kEstimated);
  }
  CSLAM_CHECK(false, "alignment {}", static_cast<int>(mode));
  return {};
}

}  // namespace

AteResult EvaluateAte(const Trajectory& reference, const Trajectory& estimate,
                      const AteOptions& options) {
  AteResult result;
  result.options = options;
  result.association = AssociatePosesOrThrow(reference, estimate, options.association);
  const std::vector<PosePair>& pairs = result.association.pairs;
  result.alignment = FindAlignment(pairs, options.alignment);
  for (const PosePair& pair : pairs) {
    result.errors_m.push_back(
        (pair.reference.translation - result.alignment * pair.estimate.translation).norm());
  }
  result.statistics_m = Summarise(result.errors_m);
  result.alignment.rmse_m = result.statistics_m.rmse;
  return result;
}

Se3 Align(const Alignment& alignment, const Se3& T_world_camera) {
  return Se3(alignment.T_a_b.rotation * T_world_camera.rotation,
             alignment * T_world_camera.translation);
}

Trajectory Align(const Alignment& alignment, const Trajectory& estimate) {
  Trajectory aligned;
  aligned.reserve(estimate.size());
  for (const auto& [stamp, T_world_camera] : estimate)
    aligned.push_back({stamp, Align(alignment, T_world_camera)});
  return aligned;
}

std::string Describe(TrajectoryAlignment alignment) {
  switch (alignment) {
    case TrajectoryAlignment::kNone:
      return "no alignment";
    case TrajectoryAlignment::kOrigin:
      return "alignment of the first pose";
    case TrajectoryAlignment::kSe3:
      return "SE(3) Umeyama alignment without scale";
    case TrajectoryAlignment::kSim3:
      return "Sim(3) Umeyama alignment with scale";
  }
  CSLAM_CHECK(false, "alignment {}", static_cast<int>(alignment));
  return {};
}

}  // namespace cslam
