// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/object_report.h"

#include <map>

namespace cslam {
namespace {

struct PointCounts {
  int all = 0;
  int active = 0;
};

std::map<ObjectId, PointCounts> CountPoints(const MapView& map) {
  std::map<ObjectId, PointCounts> counts;
  for (std::size_t i = 0; i < map.num_point_ids(); ++i) {
    const MapPoint& point = map.PointSlot(i);
    if (!point.IsActive() || !point.object.valid()) continue;
    ++counts[point.object].all;
    counts[point.object].active += IsUsable(point) ? 1 : 0;
  }
  return counts;
}

// The box along the world's axes that holds the surface.
Eigen::AlignedBox3d ExtentOf(const MapObject& object, const Se3& T_world_object) {
  Eigen::AlignedBox3d extent;
  if (object.surface) {
    for (const Eigen::Vector3f& p : object.surface->samples)
      extent.extend(T_world_object * p.cast<double>());
  }
  if (extent.isEmpty()) extent.extend(T_world_object * object.centroid);
  return extent;
}

// What has moved is called as where it was seen last: there all earlier votes count as well.
std::map<ObjectId, int> ClassesOfThings(const MapView& map) {
  std::map<ObjectId, ObjectId> next;  // of a thing that moved
  for (const MapChange& change : map.changes()) {
    const auto from = map.Resolve(change.object);
    const auto to = map.Resolve(change.new_object);
    if (change.kind == MapChangeKind::kMoved && from && to) next[*from] = *to;
  }
  const auto last_of = [&](ObjectId id) {
    for (std::size_t steps = 0; steps < next.size() && next.contains(id); ++steps)
      id = next.at(id);
    return id;
  };
  std::map<ObjectId, int> classes;
  for (const ObjectId id : map.Objects())
    classes[id] = map.FindObject(last_of(id))->class_id;
  return classes;
}

ReportedObject Report(const MapView& map, const MapObject& object, int class_id,
                      const PointCounts& points) {
  const Se3 T_world_object = map.T_world_object(object);
  const Eigen::AlignedBox3d extent = ExtentOf(object, T_world_object);
  ReportedObject reported;
  reported.id = static_cast<int>(object.id.value());
  reported.map = static_cast<int>(object.map.value());
  reported.class_id = class_id;
  reported.state = ToString(object.state);
  reported.belief = BeliefOf(object);
  reported.centroid = T_world_object * object.centroid;
  reported.box_center = T_world_object * object.box.center;
  reported.box_size_m = object.box.size_m;
  reported.box_rotation = T_world_object.rotation * object.box.rotation;
  reported.extent_min = extent.min();
  reported.extent_max = extent.max();
  reported.num_points = points.all;
  reported.num_active_points = points.active;
  reported.first_seen = object.first_seen;
  reported.last_seen = object.last_seen;
  reported.absent_since = object.absent_since;
  for (const BeliefStep& step : object.history) {
    reported.history.push_back(
        {step.stamp, static_cast<double>(step.belief), ToString(step.cause)});
  }
  return reported;
}

ChangeKind KindOf(MapChangeKind kind) {
  switch (kind) {
    case MapChangeKind::kRemoved:
      return ChangeKind::kRemoved;
    case MapChangeKind::kAdded:
      return ChangeKind::kAdded;
    case MapChangeKind::kMoved:
      return ChangeKind::kMoved;
    case MapChangeKind::kReplaced:
      return ChangeKind::kReplaced;
  }
  return ChangeKind::kMoved;
}

}  // namespace

ReportedObjects ReportObjects(const RunResult& result, const std::string& sequence) {
  const MapView& map = result.snapshot->map;
  const MapId largest = LargestMap(result);
  const auto points = CountPoints(map);
  const auto classes = ClassesOfThings(map);
  ReportedObjects report;
  report.sequence = sequence;
  for (const ObjectId id : map.Objects()) {
    const MapObject& object = *map.FindObject(id);
    if (object.map != largest) continue;
    const auto counts = points.find(id);
    report.objects.push_back(Report(map, object, classes.at(id),
                                    counts == points.end() ? PointCounts{} : counts->second));
  }
  return report;
}

ReportedChanges ReportChanges(const RunResult& result, const std::string& sequence) {
  const MapView& map = result.snapshot->map;
  const MapId largest = LargestMap(result);
  const auto classes = ClassesOfThings(map);
  ReportedChanges report;
  report.sequence = sequence;
  for (const MapChange& change : map.changes()) {
    const auto id = map.Resolve(change.object);
    if (!id || map.FindObject(*id)->map != largest) continue;
    const MapObject& object = *map.FindObject(*id);
    ReportedChange reported;
    reported.kind = KindOf(change.kind);
    reported.object = static_cast<int>(id->value());
    reported.class_id = classes.at(*id);
    const Eigen::Vector3d place = map.CentroidOf(object);
    if (change.kind == MapChangeKind::kAdded) {
      reported.to = place;
    } else {
      reported.from = place;
    }
    if (const auto new_id = map.Resolve(change.new_object)) {
      const MapObject& new_object = *map.FindObject(*new_id);
      reported.to = map.CentroidOf(new_object);
      reported.new_object = static_cast<int>(new_id->value());
      if (change.kind == MapChangeKind::kReplaced) {
        reported.new_class_id = classes.at(*new_id);
      }
    }
    reported.last_seen_there = change.last_seen_there;
    reported.first_seen_absent = change.first_seen_absent;
    reported.reported = change.reported;
    reported.confidence = change.confidence;
    reported.num_absent_views = change.num_absent_views;
    reported.num_seen_views = change.num_seen_views;
    reported.is_between_sessions = change.is_between_sessions;
    report.changes.push_back(std::move(reported));
  }
  return report;
}

}  // namespace cslam
