// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/correction.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace cslam {
namespace {

bool IsSame(const Se3& a, const Se3& b) {
  return a.rotation.coeffs() == b.rotation.coeffs() && a.translation == b.translation;
}

// How each keyframe of a map moves, by id; a keyframe that the correction does not know moves with
// its parent.
class Moves {
 public:
  Moves(const MapView& map, MapId id, const std::vector<KeyframeMove>& known)
      : moves_(map.num_keyframe_ids()) {
    for (const KeyframeMove& move : known) {
      if (move.keyframe.index() < moves_.size()) moves_[move.keyframe.index()] = move.T_new_old;
    }
    for (const KeyframeId keyframe : map.Keyframes()) {
      if (map.FindKeyframe(keyframe)->map != id) continue;
      keyframes_.push_back(keyframe);
      if (!moves_[keyframe.index()].has_value()) Carry(map, keyframe);
    }
  }

  const std::vector<KeyframeId>& keyframes() const { return keyframes_; }
  int num_carried() const { return num_carried_; }
  const Se3& Of(KeyframeId id) const { return *moves_[id.index()]; }

 private:
  void Carry(const MapView& map, KeyframeId keyframe) {
    std::vector<KeyframeId> unknown;
    KeyframeId at = keyframe;
    while (at.valid() && !moves_[at.index()].has_value()) {
      unknown.push_back(at);
      at = map.FindKeyframe(at)->parent;
    }
    const Se3 move = at.valid() ? *moves_[at.index()] : Se3();
    for (const KeyframeId id : unknown)
      moves_[id.index()] = move;
    num_carried_ += static_cast<int>(unknown.size());
  }

  std::vector<std::optional<Se3>> moves_;
  std::vector<KeyframeId> keyframes_;  // of the map, alive
  int num_carried_ = 0;
};

std::vector<PointId> PointsOf(const MapView& map, MapId id) {
  std::vector<PointId> points;
  for (std::size_t i = 0; i < map.num_point_ids(); ++i) {
    const MapPoint* point = map.FindPoint(PointId(static_cast<std::uint32_t>(i)));
    if (point != nullptr && point->map == id) points.push_back(point->id);
  }
  return points;
}

std::string WhyOutdated(const MapView& map, MapId id, std::uint32_t epoch) {
  if (epoch != map.correction_epoch()) return "the map was corrected in the meantime";
  for (const KeyframeId keyframe : map.Keyframes()) {
    if (map.FindKeyframe(keyframe)->map == id) return {};
  }
  return fmt::format("map {} is gone", id.value());
}

std::string WhyRefused(const MapView& map, const MapCorrection& correction) {
  if (auto reason = WhyOutdated(map, correction.map, correction.epoch); !reason.empty()) {
    return reason;
  }
  const MapId match_map = correction.merge_into.valid() ? correction.merge_into : correction.map;
  const auto match = map.Resolve(correction.loop.match);
  const auto query = map.Resolve(correction.loop.query);
  if (!match || map.FindKeyframe(match->keyframe)->map != match_map) {
    return fmt::format("keyframe {} is gone", correction.loop.match.value());
  }
  if (!query || map.FindKeyframe(query->keyframe)->map != correction.map) {
    return fmt::format("keyframe {} is gone", correction.loop.query.value());
  }
  return {};
}

bool Fuse(Map& map, PointId keep_id, PointId drop_id) {
  const auto keep = map.Resolve(keep_id);
  const auto drop = map.Resolve(drop_id);
  if (!keep || !drop || *keep == *drop) return false;
  if (map.FindPoint(*keep)->map != map.FindPoint(*drop)->map) return false;
  map.FusePoints(*keep, *drop);
  return true;
}

// Adds the observations; where the mapper has found another point since, the two are one.
void AddFound(Map& map, const std::vector<FoundPoint>& found, CorrectionReport& report) {
  for (const FoundPoint& f : found) {
    const auto point = map.Resolve(f.point);
    const Keyframe* keyframe = map.FindKeyframe(f.keyframe);
    if (!point || keyframe == nullptr || keyframe->map != map.FindPoint(*point)->map) continue;
    const PointId present = keyframe->points.at(static_cast<std::size_t>(f.keypoint));
    if (present.valid()) {
      report.points_fused += Fuse(map, *point, present) ? 1 : 0;
    } else if (map.AddObservation(*point, f.keyframe, f.keypoint)) {
      map.RefreshAppearance(*point);
      ++report.observations_added;
    }
  }
}

bool IsSeenBy(const MapPoint& point, KeyframeId keyframe) {
  return std::any_of(point.observations.begin(), point.observations.end(),
                     [&](const PointObservation& o) { return o.keyframe == keyframe; });
}

// Returns how many keyframes had changed since the snapshot.
int RefinePoses(Map& map, const PoseRefinement& refinement, const Moves& moves) {
  std::vector<const PoseRefinement::Pose*> refined(map.num_keyframe_ids(), nullptr);
  for (const PoseRefinement::Pose& pose : refinement.poses) {
    if (pose.keyframe.index() < refined.size()) refined[pose.keyframe.index()] = &pose;
  }
  int num_changed = 0;
  for (const KeyframeId id : moves.keyframes()) {
    const PoseRefinement::Pose* pose = refined[id.index()];
    const Se3& present = map.FindKeyframe(id)->T_world_camera;
    if (pose != nullptr && IsSame(present, pose->T_world_camera_old)) {
      map.SetPose(id, pose->T_world_camera_new);
      continue;
    }
    if (pose != nullptr) ++num_changed;
    map.SetPose(id, moves.Of(id) * present);
  }
  return num_changed;
}

void RefinePositions(Map& map, const PoseRefinement& refinement, const Moves& moves,
                     const std::vector<PointId>& points) {
  std::vector<const PoseRefinement::Position*> refined(map.num_point_ids(), nullptr);
  for (const PoseRefinement::Position& position : refinement.positions) {
    if (position.point.index() < refined.size()) refined[position.point.index()] = &position;
  }
  for (const PointId id : points) {
    const MapPoint& point = *map.FindPoint(id);
    const PoseRefinement::Position* position = refined[id.index()];
    const bool is_unchanged = position != nullptr && point.p_world == position->p_world_old;
    map.SetPosition(
        id, is_unchanged ? position->p_world_new : moves.Of(point.reference) * point.p_world);
  }
}

int RemoveOutliers(Map& map, const std::vector<PoseRefinement::Observation>& outliers) {
  int removed = 0;
  for (const PoseRefinement::Observation& o : outliers) {
    const MapPoint* point = map.FindPoint(o.point);
    if (point == nullptr || !IsSeenBy(*point, o.keyframe)) continue;
    map.RemoveObservation(o.point, o.keyframe);
    ++removed;
  }
  return removed;
}

void RefreshAll(Map& map, const std::vector<PointId>& points) {
  for (const PointId id : points) {
    if (map.FindPoint(id) != nullptr) map.RefreshGeometry(id);
  }
}

}  // namespace

CorrectionReport ApplyCorrection(Map& map, const MapCorrection& correction) {
  CorrectionReport report;
  report.refusal = WhyRefused(map, correction);
  if (!report.is_applied()) return report;

  const Moves moves(map, correction.map, correction.moves);
  const std::vector<PointId> points = PointsOf(map, correction.map);
  for (const KeyframeId id : moves.keyframes())
    map.SetPose(id, moves.Of(id) * map.FindKeyframe(id)->T_world_camera);
  for (const PointId id : points) {
    const MapPoint& point = *map.FindPoint(id);
    map.SetPosition(id, moves.Of(point.reference) * point.p_world);
  }
  if (correction.merge_into.valid()) {
    map.MergeMaps(correction.merge_into, correction.map,
                  map.Resolve(correction.loop.match)->keyframe,
                  map.Resolve(correction.loop.query)->keyframe);
  } else {
    map.AddLoop(correction.loop);
  }
  for (const PointPair& pair : correction.pairs)
    report.points_fused += Fuse(map, pair.keep, pair.drop) ? 1 : 0;
  AddFound(map, correction.found, report);
  RefreshAll(map, points);
  map.AdvanceCorrectionEpoch();

  report.keyframes_moved = static_cast<int>(moves.keyframes().size());
  report.keyframes_carried = moves.num_carried();
  report.points_moved = static_cast<int>(points.size());
  return report;
}

CorrectionReport ApplyRefinement(Map& map, const PoseRefinement& refinement) {
  CorrectionReport report;
  report.refusal = WhyOutdated(map, refinement.map, refinement.epoch);
  if (!report.is_applied()) return report;

  std::vector<KeyframeMove> known;
  known.reserve(refinement.poses.size());
  for (const PoseRefinement::Pose& pose : refinement.poses) {
    known.push_back({pose.keyframe, pose.T_world_camera_new * pose.T_world_camera_old.Inverse()});
  }
  const Moves moves(map, refinement.map, known);
  const std::vector<PointId> points = PointsOf(map, refinement.map);
  const int num_changed = RefinePoses(map, refinement, moves);
  RefinePositions(map, refinement, moves, points);
  report.observations_removed = RemoveOutliers(map, refinement.outliers);
  RefreshAll(map, points);
  map.AdvanceCorrectionEpoch();  // what else was worked out on that snapshot would move all twice

  report.keyframes_moved = static_cast<int>(moves.keyframes().size());
  report.keyframes_carried = moves.num_carried() + num_changed;
  report.points_moved = static_cast<int>(points.size());
  return report;
}

}  // namespace cslam
