// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/object_points.h"

#include <algorithm>

namespace cslam {
namespace {

// A point is an object's if at least half of the keyframes that see it see it on such a thing.
bool ShouldBelong(const Map& map, const MapPoint& point, ObjectId object,
                  const ObjectClasses& classes) {
  const int class_id = map.FindObject(object)->class_id;
  int on = 0;
  for (const PointObservation& o : point.observations) {
    const KeypointSemantics& semantics =
        map.FindKeyframe(o.keyframe)
            ->data->features.semantics[static_cast<std::size_t>(o.keypoint)];
    on += semantics.class_id >= 0 && classes.AreAlike(semantics.class_id, class_id) ? 1 : 0;
  }
  return 2 * on >= static_cast<int>(point.observations.size());
}

// The box of a thing that has gone, and some room around it.
struct LeftPlace {
  ObjectId object;
  MapId map;
  Eigen::Vector3d center_world = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R_box_world = Eigen::Matrix3d::Identity();
  Eigen::Array3d half_m = Eigen::Array3d::Zero();

  bool Contains(const Eigen::Vector3d& p_world) const {
    const Eigen::Vector3d offset = p_world - center_world;
    if (offset.squaredNorm() > half_m.matrix().squaredNorm()) return false;
    return ((R_box_world * offset).array().abs() <= half_m).all();
  }
};

LeftPlace PlaceOf(const MapView& map, const MapObject& object, double margin_m) {
  const Se3 T_world_object = map.T_world_object(object);
  LeftPlace place;
  place.object = object.id;
  place.map = object.map;
  place.center_world = T_world_object * object.box.center;
  place.R_box_world = (T_world_object.R() * object.box.rotation.toRotationMatrix()).transpose();
  place.half_m = 0.5 * object.box.size_m.array() + margin_m;
  return place;
}

}  // namespace

void AssignPoints(Map& map, KeyframeId keyframe, std::span<const PointId> points,
                  const std::map<TrackId, ObjectId>& objects_of_tracks,
                  const ObjectClasses& classes) {
  if (objects_of_tracks.empty()) return;
  for (const PointId id : points) {
    const MapPoint* point = id.valid() ? map.FindPoint(id) : nullptr;
    if (point == nullptr || point->object.valid()) continue;
    const auto seen =
        std::find_if(point->observations.begin(), point->observations.end(),
                     [&](const PointObservation& o) { return o.keyframe == keyframe; });
    if (seen == point->observations.end()) continue;
    const KeypointSemantics& semantics =
        map.FindKeyframe(keyframe)
            ->data->features.semantics[static_cast<std::size_t>(seen->keypoint)];
    const auto object = objects_of_tracks.find(semantics.track);
    if (object == objects_of_tracks.end() || map.FindObject(object->second) == nullptr) continue;
    if (ShouldBelong(map, *point, object->second, classes)) map.AssignPoint(id, object->second);
  }
}

void SweepPlaces(Map& map, std::span<const ObjectId> gone, const KeyframeProposal& proposal,
                 const MapObjectOptions& options) {
  const DepthView& view = proposal.objects.view;
  if (view.empty() || gone.empty()) return;
  std::vector<LeftPlace> places;
  for (const ObjectId id : gone)
    places.push_back(PlaceOf(map, *map.FindObject(id), options.sweep_margin_m));
  const Se3 T_camera_world = map.FindKeyframe(proposal.id)->T_world_camera.Inverse();
  const DepthSampler sampler{&view.depth_mm, view.step, &view.camera, false};
  for (std::size_t i = 0; i < map.num_point_ids(); ++i) {
    const MapPoint* point = map.FindPoint(PointId(static_cast<std::uint32_t>(i)));
    if (point == nullptr || point->object.valid()) continue;
    const auto place = std::find_if(places.begin(), places.end(), [&](const LeftPlace& one) {
      return one.map == point->map && one.Contains(point->p_world);
    });
    if (place == places.end()) continue;
    const PointVerdict verdict =
        LookAtPoint(T_camera_world * point->p_world, sampler, 0.0, options.view);
    if (verdict == PointVerdict::kThrough) map.AssignPoint(point->id, place->object);
  }
}

}  // namespace cslam
