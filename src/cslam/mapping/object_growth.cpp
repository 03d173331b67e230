// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/object_growth.h"

#include "cslam/mapping/object_geometry.h"

#include <algorithm>

namespace cslam {
namespace {

// Small things need small cells.
double VoxelM(double class_distance_m, const MapObjectOptions& options) {
  return std::min(options.voxel_m, std::max(0.01, 0.05 * class_distance_m));
}

void MixColours(MapObject& object, const ColourHistogram& colours) {
  const float share = 1.0F / static_cast<float>(object.num_sightings + 1);
  for (std::size_t i = 0; i < colours.size(); ++i)
    object.colours[i] += share * (colours[i] - object.colours[i]);
}

// The paper's extent.
void MeasureByPoints(const Map& map, MapObject& object) {
  std::vector<Eigen::Vector3d> points;
  for (const PointId id : map.PointsOfObject(object.id))
    points.push_back(map.FindPoint(id)->p_world);
  if (points.empty()) return;
  const Se3 T_object_world = map.T_world_object(object).Inverse();
  const Eigen::AlignedBox3d extent = ExtentOfPoints(points);
  object.centroid = T_object_world * CentroidOfPoints(points);
  object.box.center = T_object_world * extent.center().eval();
  object.box.size_m = extent.sizes();
  object.box.rotation = T_object_world.rotation;
}

// By votes, as far as they fit the size.
int MostLikelyClass(const MapObject& object, const ObjectClasses& classes) {
  int class_id = object.class_id;
  double most = 0.0;
  for (const MapObject::ClassVote& vote : object.votes) {
    const double votes = static_cast<double>(vote.weight) *
                         classes.SizeWeight(vote.class_id, object.box.size_m.maxCoeff());
    if (votes <= most) continue;
    most = votes;
    class_id = vote.class_id;
  }
  return class_id;
}

}  // namespace

ObjectGrowth::ObjectGrowth(const MapObjectOptions& options, const ObjectClasses& classes)
    : options_(options), classes_(classes), extent_source_(ExtentSourceOf(options)) {}

MapObject ObjectGrowth::Begin(const Map& map, MapId map_id, const KeyframeProposal& proposal,
                              const PlacedSighting& sighting) const {
  MapObject object;
  object.map = map_id;
  object.class_id = sighting.sighting->class_id;
  object.reference = proposal.id;
  ObjectSurface surface;
  surface.voxel_m = VoxelM(classes_.DistanceM(object.class_id), options_);
  object.surface = std::make_shared<const ObjectSurface>(std::move(surface));
  object.first_box = sighting.sighting->box;
  object.first_keyframe = proposal.id;
  object.arrived_keyframe = proposal.id;
  object.first_seen = sighting.sighting->detected;
  object.first_session = static_cast<std::uint32_t>(map.SessionOf(proposal.id));
  NoteBelief(object, proposal.data->stamp, BeliefCause::kCreated);
  return object;
}

MapObject ObjectGrowth::AtPastPlace(const Map& map, const MapObject& object, const PastPlace& place,
                                    const Eigen::Vector3d& up_world) const {
  MapObject past;
  past.map = object.map;
  past.state = ObjectState::kAbsent;
  past.class_id = object.class_id;
  past.log_odds = LogOdds(options_.belief.absent_at);
  past.reference = place.reference;
  ObjectSurface surface;
  surface.voxel_m = object.surface->voxel_m;
  past.surface = std::make_shared<const ObjectSurface>(
      WithView(surface, place.points, Se3(), DepthView{}, DepthRegion{}, 0.0));
  past.colours = place.colours;
  past.first_keyframe = past.arrived_keyframe = place.first_keyframe;
  past.last_keyframe = place.last_keyframe;
  past.first_seen = map.FindKeyframe(place.first_keyframe)->data->stamp;
  past.last_seen = map.FindKeyframe(place.last_keyframe)->data->stamp;
  past.absent_since = place.first_through;
  past.first_session = static_cast<std::uint32_t>(map.SessionOf(place.first_keyframe));
  past.last_session = static_cast<std::uint32_t>(map.SessionOf(place.last_keyframe));
  past.num_sightings = place.num_views;
  NoteBelief(past, place.first_through, BeliefCause::kLookedThrough);
  return Measured(map, std::move(past), up_world);
}

MapObject ObjectGrowth::WithSighting(const Map& map, MapObject object,
                                     const KeyframeProposal& proposal,
                                     const PlacedSighting& sighting,
                                     const Eigen::Vector3d& up_world) const {
  const Se3 T_object_camera =
      map.T_world_object(object).Inverse() * map.FindKeyframe(proposal.id)->T_world_camera;
  const double depth_m = static_cast<double>(sighting.region.median_m);
  const double tolerance_m = options_.view.ToleranceM(depth_m);
  object.surface = std::make_shared<const ObjectSurface>(
      WithView(*object.surface, sighting.points_camera, T_object_camera, proposal.objects.view,
               sighting.region, tolerance_m));
  MixColours(object, sighting.sighting->colours);
  AddVote(object, {static_cast<std::int16_t>(sighting.sighting->class_id),
                   static_cast<float>(sighting.sighting->score)});
  object.current_box = sighting.sighting->box;
  object.track = sighting.sighting->track;
  object.last_keyframe = proposal.id;
  object.last_seen = proposal.data->stamp;
  object.last_session = static_cast<std::uint32_t>(map.SessionOf(proposal.id));
  ++object.num_sightings;
  return Measured(map, std::move(object), up_world);
}

MapObject ObjectGrowth::Measured(const Map& map, MapObject object,
                                 const Eigen::Vector3d& up_world) const {
  const std::vector<Eigen::Vector3f> trusted = TrustedPoints(*object.surface);
  if (trusted.empty()) return object;
  object.centroid = MeanOf(trusted);
  const Eigen::Vector3d up = map.T_world_object(object).R().transpose() * up_world;
  object.box = BoxAround(trusted, up);
  if (extent_source_ == ExtentSource::kPoints) MeasureByPoints(map, object);
  object.class_id = MostLikelyClass(object, classes_);
  return object;
}

}  // namespace cslam
