// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// An object layer, and a room whose things it gets to see keyframe by keyframe.

#include "cslam/mapping/object_layer.h"
#include "cslam/mapping/test_objects.h"
#include "cslam/semantics/coco.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace cslam::test {

inline constexpr int kCouchClass = 57;
inline constexpr int kTableClass = 60;
inline constexpr int kBearClass = 77;
inline const Eigen::Vector3d kPlace(0.0, 0.2, 2.0);
inline const Eigen::Vector3d kChairSize(0.5, 0.8, 0.5);

class ObjectLayerTest : public ::testing::Test {
 protected:
  ObjectLayerTest() { MakeLayer({}); }
  ~ObjectLayerTest() override { EXPECT_EQ(map_.CheckInvariants(), ""); }

  void MakeLayer(const MapObjectOptions& objects) {
    MapperOptions options;
    options.objects = objects;
    layer_.emplace(camera_, DepthOptions{}, options, MeasurementModel(kRoomScales, 1.0));
  }
  static Thing Chair(const Eigen::Vector3d& at, std::uint32_t track = 1) {
    return {BoxAt(at, kChairSize), kChairClass, TrackId(track), 2.0F};
  }

  // A keyframe that sees the room, one second after the last unless said otherwise.
  ObjectLayerReport Insert(const Se3& T_world_camera, std::vector<ObjectEvidence> evidence = {}) {
    ThingView seen = LookAtThings(room_, camera_, T_world_camera, now_);
    KeyframeProposal proposal;
    proposal.objects = {seen.view, std::move(seen.sightings), std::move(evidence)};
    bgr_small_ = seen.bgr_small;
    return Insert(T_world_camera, std::move(proposal));
  }
  ObjectLayerReport Insert(const Se3& T_world_camera, KeyframeProposal proposal) {
    const auto id = static_cast<std::uint32_t>(map_.num_keyframe_ids());
    proposal.id = KeyframeId(id);
    proposal.map = MapId(0);
    auto data = std::make_shared<KeyframeData>();
    data->stamp = now_;
    data->depth_small_mm = proposal.objects.view.depth_mm;
    data->bgr_small = std::exchange(bgr_small_, {});
    data->features = MakeFeatures(
        {{.u = 320.0F, .v = 240.0F, .depth_m = 1.75F}, {.u = 10.0F, .v = 10.0F, .depth_m = 3.0F}});
    data->features.semantics[0].track = keypoint_track_;
    data->features.semantics[0].class_id = keypoint_track_.valid() ? kChairClass : -1;
    proposal.data = data;
    Keyframe keyframe;
    keyframe.id = proposal.id;
    keyframe.map = MapId(0);
    keyframe.T_world_camera = T_world_camera;
    if (id > 0) keyframe.parent = KeyframeId(0);
    keyframe.data = data;
    map_.AddKeyframe(std::move(keyframe));
    for (int i = 0; i < (has_points_ ? 2 : 0); ++i) {
      const Keypoint& k = data->features.keypoints[static_cast<std::size_t>(i)];
      const PointId point = map_.AddPoint(
          T_world_camera * Unproject(camera_, k.uv_px.cast<double>(), k.depth_m), proposal.id);
      map_.AddObservation(point, proposal.id, i);
      map_.RefreshAppearance(point);
    }
    now_ = now_ + 1'000'000'000LL;
    return layer_->Update(map_, proposal);
  }

  ObjectEvidence Seen(ObjectId id, int views = 3) const {
    ObjectEvidence evidence;
    evidence.object = id;
    evidence.num_seen = views;
    evidence.last_seen = now_;
    evidence.log_ratio = views * SeenLogRatio(0.1, 0.7, belief_);
    return evidence;
  }
  ObjectEvidence Through(ObjectId id, int views = 3) const {
    ObjectEvidence evidence;
    evidence.object = id;
    evidence.num_through = views;
    evidence.first_through = now_;
    evidence.log_ratio = views * LookedThroughLogRatio(belief_);
    return evidence;
  }
  // What depth and detections of a frame say of the map's objects, as the tracker gathers it.
  std::vector<ObjectEvidence> EvidenceOf(const Se3& T_world_camera) const {
    const ThingView seen = LookAtThings(room_, camera_, T_world_camera, now_);
    const DepthSampler sampler{&seen.view.depth_mm, seen.view.step, &camera_, false};
    const ObjectClasses classes{ObjectClassOptions{}};
    std::vector<ObjectEvidence> evidence;
    for (const ObjectId id : map_.Objects()) {
      const MapObject& object = *map_.FindObject(id);
      const Se3 T_camera_object = T_world_camera.Inverse() * map_.T_world_object(object);
      const ExpectedView view =
          LookAtPlace(object.surface->samples, T_camera_object, sampler, 0.0, {});
      const bool is_named = std::ranges::any_of(seen.sightings, [&](const ObjectSighting& s) {
        return classes.AreAlike(s.class_id, object.class_id) &&
               FindStanding(object.surface->samples, T_camera_object, seen.view, s.region.mask, {})
                       .covered_share() > 0.5;
      });
      if (view.verdict == PlaceVerdict::kLookedThrough && object.state != ObjectState::kAbsent) {
        evidence.push_back(Through(id, 1));
      } else if (view.verdict == PlaceVerdict::kStanding && is_named) {
        evidence.push_back(Seen(id, 1));
      }
    }
    return evidence;
  }
  // Keyframes that see the room and gather evidence.
  void Watch(const Se3& T_world_camera, int num_keyframes) {
    for (int i = 0; i < num_keyframes; ++i)
      Insert(T_world_camera, EvidenceOf(T_world_camera));
  }
  std::vector<ObjectId> Present() const {
    std::vector<ObjectId> present = map_.Objects();
    std::erase_if(present,
                  [&](ObjectId id) { return map_.FindObject(id)->state != ObjectState::kPresent; });
    return present;
  }
  // The room's things, seen until they are believed in; returns the objects of the map.
  std::vector<ObjectId> Settle(const Se3& T_world_camera) {
    Insert(T_world_camera);
    std::vector<ObjectEvidence> evidence;
    for (const ObjectId id : map_.Objects()) {
      if (map_.FindObject(id)->last_keyframe.index() + 1 == map_.num_keyframe_ids()) {
        evidence.push_back(Seen(id));
      }
    }
    Insert(T_world_camera, std::move(evidence));
    return map_.Objects();
  }
  const MapObject& Object(std::uint32_t id) const { return *map_.FindObject(ObjectId(id)); }

  const Camera camera_ = RoomCamera();
  const PersistenceOptions belief_;
  const Se3 front_ = PoseLookingAt({0.0, 0.2, 0.0}, kPlace);
  ThingRoom room_;
  Map map_{kRoomScales};
  std::optional<ObjectLayer> layer_;
  Stamp now_{1'000'000'000LL};
  bool has_points_ = false;
  TrackId keypoint_track_;
  cv::Mat bgr_small_;  // of the next keyframe
};

}  // namespace cslam::test
