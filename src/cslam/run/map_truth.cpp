// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/map_truth.h"

#include "cslam/atlas_io/map_export.h"
#include "cslam/eval/ate.h"
#include "cslam/util/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace cslam {
namespace {

// Stamps of another recording fit by chance only, and then the shapes do not.
constexpr double kMaxKeyframeRmseM = 0.2;

std::set<MapId> MapsOf(const MapView& map) {
  std::set<MapId> maps;
  for (const KeyframeId id : map.Keyframes())
    maps.insert(map.FindKeyframe(id)->map);
  return maps;
}

}  // namespace

std::optional<Se3> PoseAt(const Trajectory& truth, Stamp stamp) {
  const PoseAssociationOptions options{.mode = PoseAssociationMode::kInterpolate};
  const PoseAssociation association = AssociatePoses(truth, {{stamp, Se3()}}, options);
  if (association.pairs.empty()) return std::nullopt;
  return association.pairs.front().reference;
}

MapTruth::MapTruth(const MapView& map, const Trajectory& of_keyframes, Trajectory of_frames)
    : of_frames_(std::move(of_frames)) {
  for (const MapId id : MapsOf(map)) {
    try {
      const AteResult ate = EvaluateAte(of_keyframes, KeyframeTrajectory(map, id));
      if (ate.alignment.rmse_m > kMaxKeyframeRmseM || !ate.alignment.is_unique) {
        throw Error("{} of its keyframes have a stamp of the truth, with {:.2f} m between them",
                    ate.association.pairs.size(), ate.alignment.rmse_m);
      }
      alignments_[id] = ate.alignment;
    } catch (const Error& error) {
      problems_.push_back(
          fmt::format("map {} does not fit the ground truth: {}", id.value(), error.what()));
    }
  }
}

std::optional<PoseDifference> MapTruth::ErrorOf(MapId map, Stamp stamp,
                                                const Se3& T_world_camera) const {
  const auto alignment = alignments_.find(map);
  const auto truth = PoseAt(of_frames_, stamp);
  if (!truth || alignment == alignments_.end()) return std::nullopt;
  return Difference(*truth, Align(alignment->second, T_world_camera));
}

double MapTruth::KeyframeRmse() const {
  double largest_m = 0.0;
  for (const auto& [id, alignment] : alignments_)
    largest_m = std::max(largest_m, alignment.rmse_m);
  return largest_m;
}

}  // namespace cslam
