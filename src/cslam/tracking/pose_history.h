// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/map/map_view.h"

#include <vector>

namespace cslam {

// Where the camera was in the last tracked frame, and where it probably is now.
struct PosePrediction {
  Se3 T_world_last;
  Se3 T_world_camera;
};

// The tracker's anchor in the map: its last pose relative to a keyframe, and the keyframes it has
// proposed that no snapshot shows yet.
class PoseHistory {
 public:
  // Proposals that the map knows are dropped from here: from now on the map says where they are.
  void Update(const MapView& map);

  // reference: invalid for the first keyframe of a map; the pose is then one in the world.
  void AddPending(KeyframeId id, KeyframeId reference, const Se3& T_reference_camera);

  // The pose of the frame just tracked.
  void SetLast(KeyframeId reference, const Se3& T_reference_camera);

  // No pose, nothing pending.
  void Clear();

  KeyframeId reference() const { return reference_; }
  const Se3& T_reference_last() const { return T_reference_last_; }

  // World pose of a keyframe, in the map or pending.
  std::optional<Se3> T_world_keyframe(const MapView& map, KeyframeId id) const;

  // World pose of the last frame in the map as it is now.
  std::optional<Se3> T_world_last(const MapView& map) const;

 private:
  struct Pending {
    KeyframeId id;
    KeyframeId reference;
    Se3 T_reference_self;
  };
  std::vector<Pending> pending_;
  KeyframeId reference_;
  Se3 T_reference_last_;
};

}  // namespace cslam
