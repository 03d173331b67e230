// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/tracking/pose_history.h"

#include <algorithm>

namespace cslam {

void PoseHistory::Update(const MapView& map) {
  std::erase_if(pending_, [&](const Pending& p) { return p.id.index() < map.num_keyframe_ids(); });
}

void PoseHistory::AddPending(KeyframeId id, KeyframeId reference, const Se3& T_reference_camera) {
  pending_.push_back({id, reference, T_reference_camera});
}

void PoseHistory::SetLast(KeyframeId reference, const Se3& T_reference_camera) {
  reference_ = reference;
  T_reference_last_ = T_reference_camera;
}

void PoseHistory::Clear() {
  pending_.clear();
  reference_ = KeyframeId();
}

std::optional<Se3> PoseHistory::T_world_keyframe(const MapView& map, KeyframeId id) const {
  Se3 T_current_self;
  for (auto pending = pending_.rbegin(); pending != pending_.rend(); ++pending) {
    if (pending->id != id) continue;
    T_current_self = pending->T_reference_self * T_current_self;
    id = pending->reference;
    if (!id.valid()) return T_current_self;
  }
  const auto T_world_current = map.T_world_keyframe(id);
  if (!T_world_current) return std::nullopt;
  return *T_world_current * T_current_self;
}

std::optional<Se3> PoseHistory::T_world_last(const MapView& map) const {
  const auto T_world_reference = T_world_keyframe(map, reference_);
  if (!T_world_reference) return std::nullopt;
  return *T_world_reference * T_reference_last_;
}

}  // namespace cslam
