// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/keyframe.h"
#include "cslam/map/loop_edge.h"
#include "cslam/map/map_object.h"
#include "cslam/map/map_point.h"
#include "cslam/util/cow_array.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace cslam {

// A pose expressed through a keyframe that is alive.
struct AnchoredPose {
  KeyframeId keyframe;
  Se3 T_keyframe_self;
};

// Read access to a map's contents: the mapper's own, or an immutable copy of one revision.
// Holds every map of the atlas; keyframes and points say which map they belong to.
class MapView {
 public:
  // Null when the id is unknown, culled or erased.
  const Keyframe* FindKeyframe(KeyframeId id) const;
  const MapPoint* FindPoint(PointId id) const;
  const MapObject* FindObject(ObjectId id) const;  // null also when merged

  // Ids are handed out from 0 upwards, so these bound every id in use.
  std::size_t num_keyframe_ids() const { return keyframes_.size(); }
  std::size_t num_point_ids() const { return points_.size(); }
  MapId NextMapId() const;                                      // the first above those in use
  std::size_t num_keyframes() const { return num_keyframes_; }  // alive
  std::size_t num_points() const { return num_points_; }        // active
  std::size_t num_object_ids() const { return objects_.size(); }

  // Every slot, those of culled keyframes and erased points included: for storing a map.
  const Keyframe& KeyframeSlot(std::size_t index) const { return keyframes_[index]; }
  const MapPoint& PointSlot(std::size_t index) const { return points_[index]; }
  const MapObject& ObjectSlot(std::size_t index) const { return objects_[index]; }

  // The objects that are alive (candidates, present and absent ones), by id.
  std::vector<ObjectId> Objects() const;

  // Follows merges; nullopt when the object was erased or never existed.
  std::optional<ObjectId> Resolve(ObjectId id) const;

  // Where an object is: takes the coordinates its geometry is kept in to the world.
  Se3 T_world_object(const MapObject& object) const;
  Eigen::Vector3d CentroidOf(const MapObject& object) const;  // m, world

  // What has changed, in the order it was found out.
  const std::vector<MapChange>& changes() const;

  // Grows when a correction moves a whole map or all is forgotten: what was worked out on a
  // snapshot of another epoch must not be applied any more.
  std::uint32_t correction_epoch() const { return correction_epoch_; }

  // The loops closed within maps; their keyframes may have been culled since.
  const std::vector<LoopEdge>& loops() const { return loops_; }

  // A session is one run that added to the map. The first keyframe id of each, in order; a session
  // without keyframes begins where the next one does.
  const std::vector<KeyframeId>& sessions() const { return sessions_; }
  // The index of a keyframe's session. Stamps of different sessions have nothing in common.
  std::size_t SessionOf(KeyframeId id) const;

  // Follows fusions; nullopt when the point was erased or never existed.
  std::optional<PointId> Resolve(PointId id) const;

  // Follows culled keyframes to one that is alive; nullopt when the id never existed.
  std::optional<AnchoredPose> Resolve(KeyframeId id) const;

  // World pose of a keyframe, culled or not.
  std::optional<Se3> T_world_keyframe(KeyframeId id) const;

  // The alive keyframes, by id.
  std::vector<KeyframeId> Keyframes() const;

  // Neighbours that share at least min_shared points, most shared first (ties: smaller id).
  // At most max_count.
  std::vector<CovisibleKeyframe> Neighbours(KeyframeId id, int min_shared,
                                            std::size_t max_count) const;

 protected:
  // Map changes them; whoever holds a MapView cannot.
  // NOLINTBEGIN(misc-non-private-member-variables-in-classes)
  // Slots of culled keyframes and erased points stay, so ids index directly.
  CowArray<Keyframe, 1> keyframes_;
  CowArray<MapPoint, 64> points_;
  CowArray<MapObject, 1> objects_;
  std::shared_ptr<const std::vector<MapChange>> changes_;  // null: none
  std::size_t num_keyframes_ = 0;
  std::size_t num_points_ = 0;
  std::uint32_t correction_epoch_ = 0;
  std::vector<LoopEdge> loops_;
  std::vector<KeyframeId> sessions_ = {KeyframeId(0)};
  // NOLINTEND(misc-non-private-member-variables-in-classes)
};

}  // namespace cslam
