// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map_contents.h"
#include "cslam/map/map_view.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cslam {

// The map store and its only mutators. One thread owns it; everybody else reads Snapshot()s.
// Both directions of an observation (keyframe -> point, point -> keyframe) and the covisibility
// weights change in the same call.
class Map : public MapView {
 public:
  explicit Map(std::vector<double> level_scales);

  // A stored map. Throws Error, saying what is wrong, if the contents are not those of a map.
  explicit Map(MapContents contents);

  const std::vector<double>& level_scales() const { return level_scales_; }

  // Forgets every keyframe, point and loop; their ids stay taken.
  void Clear();

  // Keyframes added from now on belong to a further session.
  void StartSession();

  // An immutable copy of the current revision; cost grows with the number of chunks only.
  MapView Snapshot();

  // keyframe.id must be new; ids in between are filled with slots that never existed. Its points
  // and covisible must be empty: observations are added afterwards.
  void AddKeyframe(Keyframe keyframe);

  // The id is taken and stands for a pose relative to forward_to from the start.
  void AddForward(KeyframeId id, KeyframeId forward_to, const Se3& T_forward_self);

  // Children of the keyframe are handed to its parent, its observations removed, and its pose
  // forwarded to its parent. A map's first keyframe stays.
  void CullKeyframe(KeyframeId id);

  // A point of the given map, made when keyframe was inserted and anchored to it.
  PointId AddPoint(const Eigen::Vector3d& p_world, KeyframeId keyframe);

  // False if the keypoint holds another point or the keyframe already sees this one.
  bool AddObservation(PointId point, KeyframeId keyframe, int keypoint);

  // The point is erased when its last observation goes.
  void RemoveObservation(PointId point, KeyframeId keyframe);

  // All that saw drop now sees keep (unless it saw both); drop's id forwards to keep.
  void FusePoints(PointId keep, PointId drop);
  void ErasePoint(PointId point);

  void SetPose(KeyframeId keyframe, const Se3& T_world_camera);
  void SetPosition(PointId point, const Eigen::Vector3d& p_world);
  void SetParent(KeyframeId keyframe, KeyframeId parent);

  // Everything of source becomes part of target; poses and positions stay. The spanning tree of
  // source is turned round to begin at child, which becomes a child of target's keyframe parent.
  void MergeMaps(MapId target, MapId source, KeyframeId parent, KeyframeId child);

  void AddLoop(const LoopEdge& loop) { loops_.push_back(loop); }

  // object.id is chosen here.
  ObjectId AddObject(MapObject object);

  // Replaces what is known of an object that is alive. Its points are held back, or no longer, as
  // is_active says.
  void SetObject(MapObject object);

  // drop continues as keep, with all its points.
  void MergeObjects(ObjectId keep, ObjectId drop);

  // The object was never there: its points are points of the room again, or erased.
  enum class PointsOfErased : std::uint8_t { kKeep, kErase };
  void EraseObject(ObjectId object, PointsOfErased points);

  // The point is part of the object; invalid: of none.
  void AssignPoint(PointId point, ObjectId object);
  std::vector<PointId> PointsOfObject(ObjectId object) const;

  void SetChanges(std::vector<MapChange> changes);

  void AdvanceCorrectionEpoch() { ++correction_epoch_; }

  // Becomes another map, which nothing worked out on a snapshot of the old one may change.
  void Replace(Map other);

  void AddSightings(PointId point, int expected, int found);

  // Recomputes the descriptor (the medoid of those observed), and what RefreshGeometry() does.
  void RefreshAppearance(PointId point);

  // Recomputes normal and distance limits; enough after positions or poses have changed.
  void RefreshGeometry(PointId point);

  // Of all maps: ids resolve, observations symmetric, weights recounted, spanning tree connected
  // and acyclic, nothing NaN. Empty when all hold; otherwise the first violation.
  std::string CheckInvariants() const;

 private:
  MapPoint& EditPoint(PointId id);
  MapObject& EditObject(ObjectId id);
  Keyframe& EditKeyframe(KeyframeId id);
  const Keypoint& KeypointOf(const PointObservation& observation) const;
  void AddSharedPoint(KeyframeId a, KeyframeId b, int change);

  std::vector<double> level_scales_;
};

}  // namespace cslam
