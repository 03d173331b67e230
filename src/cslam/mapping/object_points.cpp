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

void SweepPlace(Map& map, ObjectId id, const KeyframeProposal& proposal,
                const MapObjectOptions& options) {
  const MapObject& object = *map.FindObject(id);
  const DepthView& view = proposal.objects.view;
  if (view.empty()) return;
  const Se3 T_object_world = map.T_world_object(object).Inverse();
  const Se3 T_camera_world = map.FindKeyframe(proposal.id)->T_world_camera.Inverse();
  const Eigen::Vector3d half =
      0.5 * object.box.size_m + Eigen::Vector3d::Constant(options.sweep_margin_m);
  const Eigen::Matrix3d R_box = object.box.rotation.toRotationMatrix().transpose();
  const DepthSampler sampler{&view.depth_mm, view.step, &view.camera, false};
  for (std::size_t i = 0; i < map.num_point_ids(); ++i) {
    const MapPoint* point = map.FindPoint(PointId(static_cast<std::uint32_t>(i)));
    if (point == nullptr || point->object.valid() || point->map != object.map) continue;
    const Eigen::Vector3d p = T_object_world * point->p_world;
    const Eigen::Vector3d p_box = R_box * (p - object.box.center);
    if ((p_box.cwiseAbs().array() > half.array()).any()) continue;
    const Eigen::Vector3f sample = point->p_world.cast<float>();
    const ExpectedView seen = LookAtPlace({&sample, 1}, T_camera_world, sampler, 0.0, options.view);
    if (seen.num_through > 0) map.AssignPoint(point->id, id);
  }
}

}  // namespace cslam
