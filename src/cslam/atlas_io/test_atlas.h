// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/atlas_io/map_file.h"
#include "cslam/map/test_map.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace cslam::test {

// For tests: a map file's info for MakeKeyframe()'s 640 x 480 px camera.
inline MapFileInfo MakeMapFileInfo() {
  MapFileInfo info;
  info.program = "changing-slam test";
  info.created = "2026-11-22T04:00:00Z";
  info.camera.camera = {.fx = 517.3, .fy = 516.5, .cx = 318.6, .cy = 255.3, .k1 = 0.26};
  info.camera.name = "test";
  info.level_scales = kLevelScales;
  info.sessions = {"morning", "noon"};
  return info;
}

// A keyframe with a depth image of a wall 2 m away and labels on its first keypoints.
inline Keyframe MakeFullKeyframe(std::uint32_t id, int num_features, double x, KeyframeId parent,
                                 MapId map, const cv::Size& depth_size) {
  Keyframe keyframe = MakeKeyframe(id, num_features, x, parent, map);
  auto data = std::make_shared<KeyframeData>(*keyframe.data);
  data->depth_small_mm = cv::Mat(depth_size, CV_16UC1, cv::Scalar(2000));
  data->depth_small_mm.at<std::uint16_t>(3, 5) = static_cast<std::uint16_t>(1000 + id);
  data->bgr_small = cv::Mat(depth_size / 2, CV_8UC3, cv::Scalar(10, 20, 30));
  data->bgr_small.at<cv::Vec3b>(2, 3) = {1, 2, static_cast<unsigned char>(id)};
  data->features.semantics[0] = {KeypointLabel::kDynamic, 0, TrackId(id)};
  data->features.semantics[1] = {KeypointLabel::kMovable, 56, TrackId(7)};
  data->features.keypoints[2].depth_m = 1.5F;
  keyframe.data = std::move(data);
  return keyframe;
}

// A row of keyframes 0.1 m apart; each makes num_features / 4 points that it and the next three
// see.
inline void AddRowOfKeyframes(Map& map, MapId map_id, int num_keyframes, int num_features,
                              const cv::Size& depth_size = {40, 30}) {
  constexpr int kObservers = 4;
  const auto first = static_cast<std::uint32_t>(map.num_keyframe_ids());
  for (int k = 0; k < num_keyframes; ++k) {
    const std::uint32_t id = first + static_cast<std::uint32_t>(k);
    const KeyframeId parent = k == 0 ? KeyframeId() : KeyframeId(id - 1);
    map.AddKeyframe(MakeFullKeyframe(id, num_features, 0.1 * k, parent, map_id, depth_size));
  }
  const int points_per_keyframe = num_features / 4;
  for (int k = 0; k < num_keyframes; ++k) {
    for (int i = 0; i < points_per_keyframe; ++i) {
      const KeyframeId maker(first + static_cast<std::uint32_t>(k));
      const PointId point = map.AddPoint({0.1 * k, 0.01 * i, 3.0 + 1e-3 * i}, maker);
      for (int o = 0; o < kObservers && k + o < num_keyframes; ++o) {
        const KeyframeId observer(maker.value() + static_cast<std::uint32_t>(o));
        map.AddObservation(point, observer, o * points_per_keyframe + i);
      }
      map.RefreshAppearance(point);
    }
  }
}

inline MapObject MakeObject(KeyframeId reference, MapId map) {
  MapObject object;
  object.map = map;
  object.state = ObjectState::kPresent;
  object.class_id = 77;
  object.votes = {{77, 2.5F}, {-1, 0.25F}};
  object.log_odds = 1.75;
  object.reference = reference;
  auto surface = std::make_shared<ObjectSurface>();
  surface->voxels = {{{-3, 0, 2}, {0.1F, -0.2F, 1.5F}, 4, 1},
                     {{1, 2, 3}, {0.2F, 0.0F, 1.6F}, 9, 0}};
  surface->samples = {{0.15F, -0.1F, 1.55F}};
  object.surface = std::move(surface);
  object.centroid = {0.15, -0.1, 1.55};
  object.box = {{0.1, 0.2, 1.5}, {0.3, 0.4, 0.5}, Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5)};
  object.colours[3] = 1.0F;
  object.first_box = {1.5, 2.0, 30.0, 40.0};
  object.current_box = {2.5, 3.0, 31.0, 41.0};
  object.track = TrackId(4);
  object.first_keyframe = KeyframeId(0);
  object.arrived_keyframe = KeyframeId(0);
  object.last_keyframe = reference;
  object.first_seen = Stamp{1'000};
  object.last_seen = Stamp{2'000};
  object.absent_since = Stamp{3'000};
  object.num_sightings = 6;
  object.num_named_views = 5;
  object.num_unnamed_views = 2;
  object.history = {{Stamp{1'000}, 0.5F, BeliefCause::kCreated},
                    {Stamp{2'000}, 0.8F, BeliefCause::kSeen}};
  return object;
}

// One that is held back with a point of its own, one that was merged into it, a change of it.
inline void AddObjects(Map& map) {
  const ObjectId kept = map.AddObject(MakeObject(KeyframeId(2), MapId(0)));
  const ObjectId dropped = map.AddObject(MakeObject(KeyframeId(1), MapId(0)));
  map.AssignPoint(PointId(5), kept);
  map.MergeObjects(kept, dropped);
  MapChange change;
  change.kind = MapChangeKind::kRemoved;
  change.object = kept;
  change.last_seen_there = Stamp{2'000};
  change.reported = Stamp{4'000};
  change.confidence = 0.75;
  change.num_absent_views = 3;
  change.is_between_sessions = true;
  map.SetChanges({change});
}

// Two maps with culled keyframes, ids that never were, fused and erased points, a loop, objects and
// a second session that has no keyframe yet.
inline Map MakeAtlas() {
  Map map(kLevelScales);
  AddRowOfKeyframes(map, MapId(0), 6, 24);
  map.AddForward(KeyframeId(8), KeyframeId(2),
                 Se3(Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {1, 0, 0}));
  AddRowOfKeyframes(map, MapId(3), 3, 12);
  map.CullKeyframe(KeyframeId(3));
  map.FusePoints(PointId(1), PointId(7));
  map.FusePoints(PointId(2), PointId(1));
  map.ErasePoint(PointId(4));
  map.AddSightings(PointId(2), 12, 9);
  map.SetPose(KeyframeId(2), Se3(ExpSo3({0.1, -0.2, 0.3}), {0.2, -0.0, 1e-17}));
  map.AddLoop({KeyframeId(0), KeyframeId(5), Se3(ExpSo3({0.1, 0.2, 0.0}), {0.4, 0.0, 0.1})});
  AddObjects(map);
  map.StartSession();
  return map;
}

// Whether two keypoint grids give the same answers.
inline bool AreEqualGrids(const FrameFeatures& a, const FrameFeatures& b) {
  std::vector<int> of_a, of_b;
  for (float u = 0.0F; u < 640.0F; u += 32.0F) {
    a.grid.VisitNear({u, 240.0F}, 40.0F, [&](int index) { of_a.push_back(index); });
    b.grid.VisitNear({u, 240.0F}, 40.0F, [&](int index) { of_b.push_back(index); });
  }
  return of_a == of_b;
}

inline bool AreEqual(const Se3& a, const Se3& b) {
  return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs();
}

inline bool AreEqual(const KeypointSemantics& a, const KeypointSemantics& b) {
  return a.label == b.label && a.class_id == b.class_id && a.track == b.track;
}

inline bool AreEqual(const Keypoint& a, const Keypoint& b) {
  return a.uv_px == b.uv_px && a.raw_px == b.raw_px && a.depth_m == b.depth_m &&
         a.disparity_px == b.disparity_px && a.angle_rad == b.angle_rad && a.octave == b.octave;
}

inline bool AreEqual(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() &&
         (a.empty() || cv::norm(a, b, cv::NORM_INF) == 0.0);
}

inline bool AreEqual(const KeyframeData& a, const KeyframeData& b) {
  const auto are_equal = [](const auto& x, const auto& y) { return AreEqual(x, y); };
  const FrameFeatures& f = a.features;
  const FrameFeatures& g = b.features;
  return a.frame == b.frame && a.stamp == b.stamp &&
         std::ranges::equal(f.keypoints, g.keypoints, are_equal) &&
         f.descriptors == g.descriptors &&
         std::ranges::equal(f.semantics, g.semantics, are_equal) &&
         AreEqual(a.depth_small_mm, b.depth_small_mm) && AreEqual(a.bgr_small, b.bgr_small);
}

inline bool AreEqual(const Keyframe& a, const Keyframe& b) {
  if (a.IsAlive() != b.IsAlive() || a.forward_to != b.forward_to) return false;
  if (!a.IsAlive()) return AreEqual(a.T_forward_self, b.T_forward_self);
  return a.id == b.id && a.map == b.map && a.parent == b.parent &&
         AreEqual(a.T_world_camera, b.T_world_camera) && a.points == b.points &&
         a.covisible == b.covisible && AreEqual(*a.data, *b.data);
}

inline bool AreEqual(const MapPoint& a, const MapPoint& b) {
  if (a.id != b.id || a.state != b.state) return false;
  if (!a.IsActive()) return a.state == PointState::kErased || a.replaced_by == b.replaced_by;
  return a.map == b.map && a.p_world == b.p_world && a.normal == b.normal &&
         a.min_distance_m == b.min_distance_m && a.max_distance_m == b.max_distance_m &&
         a.angle_rad == b.angle_rad && a.descriptor == b.descriptor && a.reference == b.reference &&
         a.created_by == b.created_by && a.observations == b.observations &&
         a.times_expected == b.times_expected && a.times_found == b.times_found &&
         a.object == b.object && a.is_held_back == b.is_held_back;
}

inline bool AreEqual(const ObjectSurface* a, const ObjectSurface* b) {
  if (a == nullptr || b == nullptr) return a == b;
  return a->voxel_m == b->voxel_m && a->samples == b->samples &&
         std::ranges::equal(a->voxels, b->voxels, [](const auto& x, const auto& y) {
           return x.cell == y.cell && x.p == y.p && x.num_inside == y.num_inside &&
                  x.num_outside == y.num_outside;
         });
}

inline bool AreEqual(const MapObject& a, const MapObject& b) {
  const bool has_equal_look =
      AreEqual(a.surface.get(), b.surface.get()) && a.centroid == b.centroid &&
      a.box.center == b.box.center && a.box.size_m == b.box.size_m &&
      a.box.rotation.coeffs() == b.box.rotation.coeffs() && a.colours == b.colours &&
      a.class_id == b.class_id && std::ranges::equal(a.votes, b.votes, [](auto x, auto y) {
        return x.class_id == y.class_id && x.weight == y.weight;
      });
  const bool has_equal_sightings =
      a.first_box == b.first_box && a.current_box == b.current_box && a.track == b.track &&
      a.first_keyframe == b.first_keyframe && a.arrived_keyframe == b.arrived_keyframe &&
      a.last_keyframe == b.last_keyframe && a.first_seen == b.first_seen &&
      a.last_seen == b.last_seen && a.absent_since == b.absent_since &&
      a.first_session == b.first_session && a.last_session == b.last_session &&
      a.num_sightings == b.num_sightings && a.num_named_views == b.num_named_views &&
      a.num_unnamed_views == b.num_unnamed_views;
  return a.id == b.id && a.map == b.map && a.state == b.state && a.merged_into == b.merged_into &&
         a.log_odds == b.log_odds && a.is_active == b.is_active && a.reference == b.reference &&
         a.history == b.history && has_equal_look && has_equal_sightings;
}

inline bool AreEqual(const MapChange& a, const MapChange& b) {
  return a.kind == b.kind && a.object == b.object && a.new_object == b.new_object &&
         a.last_seen_there == b.last_seen_there && a.first_seen_absent == b.first_seen_absent &&
         a.reported == b.reported && a.confidence == b.confidence &&
         a.num_absent_views == b.num_absent_views && a.num_seen_views == b.num_seen_views &&
         a.is_between_sessions == b.is_between_sessions;
}

inline bool AreEqual(const LoopEdge& a, const LoopEdge& b) {
  return a.match == b.match && a.query == b.query && AreEqual(a.T_match_query, b.T_match_query);
}

// Empty if the maps are equal, bit by bit, in everything that can be asked of them.
inline std::string FindDifference(const MapView& a, const MapView& b) {
  if (a.num_keyframe_ids() != b.num_keyframe_ids()) return "number of keyframe ids";
  if (a.num_point_ids() != b.num_point_ids()) return "number of point ids";
  if (a.num_keyframes() != b.num_keyframes()) return "number of keyframes";
  if (a.num_points() != b.num_points()) return "number of points";
  for (std::size_t i = 0; i < a.num_keyframe_ids(); ++i) {
    if (!AreEqual(a.KeyframeSlot(i), b.KeyframeSlot(i))) return "keyframe " + std::to_string(i);
  }
  for (std::size_t i = 0; i < a.num_point_ids(); ++i) {
    if (!AreEqual(a.PointSlot(i), b.PointSlot(i))) return "point " + std::to_string(i);
  }
  if (a.num_object_ids() != b.num_object_ids()) return "number of object ids";
  for (std::size_t i = 0; i < a.num_object_ids(); ++i) {
    if (!AreEqual(a.ObjectSlot(i), b.ObjectSlot(i))) return "object " + std::to_string(i);
  }
  const auto are_equal = [](const auto& x, const auto& y) { return AreEqual(x, y); };
  if (!std::ranges::equal(a.changes(), b.changes(), are_equal)) return "changes";
  if (!std::ranges::equal(a.loops(), b.loops(), are_equal)) return "loops";
  if (a.sessions() != b.sessions()) return "sessions";
  return {};
}

}  // namespace cslam::test
