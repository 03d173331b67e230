// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/mapping/mapper_options.h"
#include "cslam/mapping/object_association.h"
#include "cslam/mapping/object_changes.h"
#include "cslam/mapping/object_growth.h"
#include "cslam/mapping/object_origins.h"
#include "cslam/messages/messages.h"
#include "cslam/vision/measurement_model.h"

#include <map>
#include <span>
#include <vector>

namespace cslam {

struct ObjectLayerReport {
  int num_new = 0;
  int num_changed = 0;  // activated, deactivated, gone, back or merged
};

// Keeps the objects of the map: which sighting is which object, where they are, how far each is
// believed in, and what has changed. Works on the owner's map, once per keyframe.
class ObjectLayer {
 public:
  ObjectLayer(const Camera& camera, const DepthOptions& depth, const MapperOptions& options,
              const MeasurementModel& model);

  ObjectLayer(const ObjectLayer&) = delete;
  ObjectLayer& operator=(const ObjectLayer&) = delete;

  // The keyframe has been added, with its observations and points. Long-term association
  // (Algorithm 3), beliefs (Eqs. 11 to 14), and what they decide.
  ObjectLayerReport Update(Map& map, const KeyframeProposal& proposal);

  // Points that were made of the keyframe's keypoints later on.
  void AssignPoints(Map& map, KeyframeId keyframe, std::span<const PointId> points) const;

  // After a loop or a merge of maps: what was kept twice for drift becomes one. Returns how many.
  int MergeAllDoubles(Map& map);

  void Reset();

 private:
  using TrackObjects = std::map<TrackId, ObjectId>;

  bool IsOfKnownTrack(const Map& map, const PlacedSighting& sighting) const;
  bool IsMistake(const MapObject& object) const;
  void EraseMistake(Map& map, ObjectId id, Map::PointsOfErased points) const;
  bool IsPiece(const PlacedSighting& sighting) const;
  int TakeEvidence(Map& map, const KeyframeProposal& proposal) const;
  bool MayUpdate(const Map& map, const MapObject& object, KeyframeId keyframe) const;
  bool Decide(Map& map, ObjectId id, const KeyframeProposal& proposal,
              const ObjectEvidence& evidence) const;
  void JudgeArrival(Map& map, ObjectId id, const KeyframeProposal& proposal) const;
  void Activate(Map& map, ObjectId id) const;
  void SweepLeftPlaces(Map& map, const KeyframeProposal& proposal) const;
  int DisplaceOthers(Map& map, ObjectId id, const KeyframeProposal& proposal) const;
  int MergeDoubles(Map& map, std::span<const ObjectId> seen, Stamp now);
  Eigen::Vector3d UpWorld() const;

  const Camera camera_;
  const DepthOptions depth_;
  const MapperOptions options_;
  const MeasurementModel model_;
  const ObjectClasses classes_;
  const BeliefUpdate belief_update_;
  const ObjectGrowth growth_;
  const ChangeList changes_;

  ObjectOrigins origins_;
  TrackObjects objects_of_tracks_;           // as seen last
  std::map<TrackId, int> strays_;            // keyframes in a row that saw it elsewhere
  std::map<MapId, Eigen::Vector3d> up_sum_;  // of the cameras' upward axes, world
  MapId map_id_;
};

}  // namespace cslam
