// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map.h"
#include "cslam/messages/messages.h"

#include <memory>
#include <vector>

namespace cslam::test {

// Stands in for the mapper where only the tracker is tested: inserts keyframes and makes points of
// all their depth readings. The map can be changed behind the tracker's back.
class TestMapper {
 public:
  TestMapper(const Camera& camera, std::vector<double> level_scales)
      : camera_(camera), map_(std::move(level_scales)) {}

  Map& map() { return map_; }

  void Apply(const KeyframeProposal& proposal) {
    ++num_applied_;
    Keyframe keyframe;
    keyframe.id = proposal.id;
    keyframe.map = proposal.map;
    keyframe.data = proposal.data;
    keyframe.T_world_camera = proposal.T_reference_camera;
    if (const auto anchor = map_.Resolve(proposal.reference)) {
      keyframe.parent = anchor->keyframe;
      keyframe.T_world_camera =
          *map_.T_world_keyframe(proposal.reference) * proposal.T_reference_camera;
    }
    const Se3 T_world_camera = keyframe.T_world_camera;
    map_.AddKeyframe(std::move(keyframe));
    const auto& keypoints = proposal.data->features.keypoints;
    for (std::size_t i = 0; i < keypoints.size(); ++i) {
      auto point = map_.Resolve(proposal.matches[i]);
      if (!point && keypoints[i].HasDepth()) {
        const auto z = static_cast<double>(keypoints[i].depth_m);
        const Eigen::Vector3d p_camera = Unproject(camera_, keypoints[i].uv_px.cast<double>(), z);
        point = map_.AddPoint(T_world_camera * p_camera, proposal.id);
      }
      if (!point) continue;
      map_.AddObservation(*point, proposal.id, static_cast<int>(i));
      map_.RefreshAppearance(*point);
    }
  }

  std::shared_ptr<const MapSnapshot> Publish() {
    auto snapshot = std::make_shared<MapSnapshot>();
    snapshot->revision = ++revision_;
    snapshot->proposals_applied = num_applied_;
    snapshot->map = map_.Snapshot();
    return snapshot;
  }

  // As a correction after a loop does: the whole map moves rigidly.
  void MoveEverything(const Se3& T_new_old) {
    for (const KeyframeId id : map_.Keyframes())
      map_.SetPose(id, T_new_old * map_.FindKeyframe(id)->T_world_camera);
    for (std::uint32_t i = 0; i < map_.num_point_ids(); ++i) {
      const MapPoint* point = map_.FindPoint(PointId(i));
      if (point == nullptr) continue;
      map_.SetPosition(PointId(i), T_new_old * point->p_world);
      map_.RefreshGeometry(PointId(i));
    }
  }

 private:
  const Camera camera_;
  Map map_;
  std::uint32_t num_applied_ = 0;
  std::uint64_t revision_ = 0;
};

}  // namespace cslam::test
