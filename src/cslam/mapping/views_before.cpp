// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/views_before.h"

namespace cslam {
namespace {

// Within the picture, or not far beside it.
bool IsInOrBesidePicture(const Eigen::Vector3d& p_camera, const Camera& camera) {
  if (p_camera.z() < 0.1) return false;
  const Eigen::Vector2d uv = Project(camera, p_camera);
  return uv.x() > -0.5 * camera.width && uv.x() < 1.5 * camera.width &&
         uv.y() > -0.5 * camera.height && uv.y() < 1.5 * camera.height;
}

}  // namespace

ViewsBefore LookBack(const MapView& map, const MapObject& object, const Camera& camera,
                     std::uint32_t session, const ExpectedViewOptions& options) {
  ViewsBefore before;
  if (!object.surface) return before;
  const Se3 T_world_object = map.T_world_object(object);
  bool is_of_this_session = false;
  for (const KeyframeId id : map.Keyframes()) {
    if (!(id < object.first_keyframe)) break;
    const Keyframe& keyframe = *map.FindKeyframe(id);
    if (keyframe.map != object.map || keyframe.data->depth_small_mm.empty()) continue;
    const Se3 T_camera_object = keyframe.T_world_camera.Inverse() * T_world_object;
    if (!IsInOrBesidePicture(T_camera_object * object.centroid, camera)) continue;
    const ExpectedView view =
        LookAtPlace(object.surface->samples, T_camera_object,
                    ThumbnailSampler(keyframe.data->depth_small_mm, camera), 0.0, options);
    if (view.verdict == PlaceVerdict::kStanding) ++before.num_standing;
    if (view.verdict != PlaceVerdict::kLookedThrough) continue;
    ++before.num_through;
    is_of_this_session =
        is_of_this_session || map.SessionOf(id) == static_cast<std::size_t>(session);
  }
  before.is_between_sessions = before.num_through > 0 && !is_of_this_session;
  return before;
}

}  // namespace cslam
