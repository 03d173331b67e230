// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/object_uses.h"

#include "cslam/objects/object_classes.h"

#include <algorithm>

namespace cslam {

ObjectUses::ObjectUses(const Camera& camera, const ObjectTrackerOptions& options)
    : focal_px_(camera.fx),
      options_(options),
      fixed_(ClassesIn(options.fixed, "tracking.objects.fixed")) {}

// What lies flat on the floor over a metre is floor, a rug taken for a bed; what is flat on a wall
// is wall. Without such points little near the camera may be left, and nothing holds its position.
bool ObjectUses::IsRoom(const FollowedObject& object) const {
  if (fixed_.contains(object.class_id)) return true;
  if (!object.is_flat || object.is_person() || object.class_id < 0) return false;
  if (object.is_on_wall) return !options_.map_flat_on_walls;
  const double side_px = std::max(object.box.width(), object.box.height());
  return side_px * static_cast<double>(object.region.median_m) / focal_px_ > options_.max_flat_m;
}

// What the camera sees little beside seems to move whenever the camera does.
bool ObjectUses::FillsThePicture(const FollowedObject& object) const {
  const std::size_t num_pixels = object.region.mask.total();
  return num_pixels > 0 &&
         object.region.num_pixels > options_.max_moving_share * static_cast<double>(num_pixels);
}

KeypointLabel ObjectUses::LabelOf(const FollowedObject& object) const {
  if (object.is_person() || object.class_id < 0) return KeypointLabel::kDynamic;
  if (IsRoom(object)) return KeypointLabel::kStatic;
  if (!options_.label_movable) return KeypointLabel::kStatic;
  if (!options_.filter_motion) return KeypointLabel::kDynamic;
  const ObjectMotion motion = object.filter ? object.filter->motion() : ObjectMotion::kUnknown;
  const bool may_use = motion == ObjectMotion::kStatic ||
                       (motion == ObjectMotion::kUnknown && !options_.hold_back_new) ||
                       FillsThePicture(object);
  return may_use ? KeypointLabel::kMovable : KeypointLabel::kDynamic;
}

}  // namespace cslam
