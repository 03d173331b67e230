// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/camera.h"
#include "cslam/geometry/se3.h"
#include "cslam/sim/camera_motion.h"
#include "cslam/sim/scene.h"
#include "cslam/sim/world.h"

#include <Eigen/Core>

#include <limits>
#include <optional>
#include <span>
#include <vector>

// What a camera may see of a world, told from boxes alone: to design stories and to prove, before
// anything is rendered, that changes happen out of view.

namespace cslam {

// Around an object; the origin of T_world_box is its centre.
struct PlacedBox {
  Se3 T_world_box;
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
};

// The box along the object's own axes around its mesh, wherever the object is.
PlacedBox BoxAround(const Mesh& mesh, const Se3& T_world_object);

// From a point to a box in m; 0 inside.
double DistanceTo(const PlacedBox& box, const Eigen::Vector3d& p_world);

// The boxes of a world's rigid objects. The world must outlive it.
class WorldBoxes {
 public:
  explicit WorldBoxes(const World& world);

  // All that are there, but for the room (0), people, and one other.
  std::vector<PlacedBox> At(double time_s, int without = 0) const;

  // Of one object, were it at that pose.
  PlacedBox Of(int instance, const Se3& T_world_object) const;

 private:
  const World& world_;
  std::vector<PlacedBox> own_;  // by instance id, in the object's frame
};

// False only if no part of the box is in the picture, be it hidden or not: with a margin of
// margin_px around the picture.
bool MayBeInView(const PlacedBox& box, const Camera& camera, const Se3& T_world_camera,
                 double margin_px);

// How well a box is seen. Shares from 0 to 1.
struct BoxView {
  double picture_share = 0.0;  // of the picture, by the rectangle around what is in it
  double inside_share = 0.0;   // of the box that is in the picture
  double clear_share = 0.0;    // of the box that is in the picture and not behind another box
};

// Occluders that hold a part of the box (a chair that a bear sits on) do not hide that part.
BoxView ViewOf(const PlacedBox& box, const Camera& camera, const Se3& T_world_camera,
               std::span<const PlacedBox> occluders);

// A resting object that leaves its place, comes, or both at once; nobody carries it.
struct SilentChange {
  int instance = 0;
  double time_s = 0.0;
  std::optional<Se3> from;  // T_world_object before; none if it was away
  std::optional<Se3> to;    // and after
  // The stretch around it in which this object's places stay as they are.
  double since_s = 0.0;
  double until_s = std::numeric_limits<double>::infinity();
};

// In order of time, then instance.
std::vector<SilentChange> SilentChanges(const World& world);

// What makes a view good enough to count.
struct ClearView {
  double min_picture_share = 0.01;
  double min_clear_share = 0.5;
  double step_s = 0.1;
};

// How a change lies between the views of its places.
struct ChangeViews {
  double unseen_before_s = 0.0;  // from the last time a place of it may be in view to the change
  double unseen_after_s = 0.0;   // from the change to the next time
  double before_s = 0.0;         // longest clear view of the old place before (or the new, if none)
  double old_after_s = 0.0;      // longest clear view of the old place afterwards
  double new_after_s = 0.0;      // and of the new one
};
ChangeViews ViewsAround(const WorldBoxes& boxes, const CameraMotion& motion, const Camera& camera,
                        const SilentChange& change, const ClearView& clear);

}  // namespace cslam
