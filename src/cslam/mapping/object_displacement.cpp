// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/object_displacement.h"

#include "cslam/objects/expected_view.h"

#include <algorithm>

namespace cslam {
namespace {

// Share of the object's surface inside the other's box.
double ShareInside(const Map& map, const MapObject& object, const MapObject& other) {
  const Se3 T_other_object = map.T_world_object(other).Inverse() * map.T_world_object(object);
  const Eigen::Matrix3d R_box = other.box.rotation.toRotationMatrix().transpose();
  int inside = 0;
  for (const Eigen::Vector3f& sample : object.surface->samples) {
    const Eigen::Vector3d p = R_box * (T_other_object * sample.cast<double>() - other.box.center);
    inside += (p.cwiseAbs().array() <= 0.5 * other.box.size_m.array()).all() ? 1 : 0;
  }
  return static_cast<double>(inside) /
         static_cast<double>(std::max<std::size_t>(1, object.surface->samples.size()));
}

// Whether some of it is still to be seen in the keyframe, and is nothing else.
bool IsSeenStanding(const Map& map, const MapObject& object, const KeyframeProposal& proposal,
                    const ObjectClasses& classes, const ExpectedViewOptions& options) {
  constexpr double kMaxStanding = 0.25;  // of the samples: floor that passed for part of it
  const DepthView& view = proposal.objects.view;
  if (view.empty()) return false;
  const Se3 T_camera_object =
      map.FindKeyframe(proposal.id)->T_world_camera.Inverse() * map.T_world_object(object);
  const cv::Mat others = CoveredByOthers(proposal.objects.sightings, object.class_id, classes);
  const DepthSampler sampler{&view.depth_mm, view.step, &view.camera, false, &others};
  const ExpectedView seen =
      LookAtPlace(object.surface->samples, T_camera_object, sampler, 0.0, options);
  return seen.num_standing > kMaxStanding * seen.num_samples &&
         seen.num_standing > seen.num_through;
}

}  // namespace

Displacement FindDisplaced(const Map& map, ObjectId comer_id, const KeyframeProposal& proposal,
                           const ObjectClasses& classes, const MapObjectOptions& options) {
  const MapObject& comer = *map.FindObject(comer_id);
  if (comer.state != ObjectState::kPresent || comer.num_sightings < options.min_displacing_views) {
    return {};
  }
  std::vector<std::pair<double, ObjectId>> displaced;
  Displacement found;
  for (const ObjectId other_id : map.Objects()) {
    const MapObject& other = *map.FindObject(other_id);
    if (other_id == comer_id || other.map != comer.map || other.state != ObjectState::kPresent ||
        !other.surface || !(other.last_keyframe < comer.arrived_keyframe) ||
        classes.AreAlike(other.class_id, comer.class_id)) {
      continue;
    }
    if (ShareInside(map, other, comer) < options.min_displaced) continue;
    if (IsSeenStanding(map, other, proposal, classes, options.view)) {
      found.still_there.push_back(other_id);
      continue;
    }
    displaced.emplace_back(-other.box.size_m.prod(), other_id);
  }
  std::sort(displaced.begin(), displaced.end());
  for (const auto& [volume, other_id] : displaced)
    found.gone.push_back(other_id);
  return found;
}

}  // namespace cslam
