// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"
#include "cslam/sim/scene.h"

#include <Eigen/Core>

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <vector>

namespace cslam {

// A stretch of time in which an object rests in one place.
struct Stay {
  double from_s = -std::numeric_limits<double>::infinity();
  double to_s = std::numeric_limits<double>::infinity();
  Se3 T_world_object;
};

struct TimedPose {
  double time_s = 0.0;
  Se3 T_world_object;
};

// An object carried or pushed: poses in order of time, interpolated between.
using Carry = std::vector<TimedPose>;

// Where a rigid object is over time. At times that no stay and no carry holds, it is away.
struct Timeline {
  std::vector<Stay> stays;     // in order of time, disjoint; from_s <= t < to_s
  std::vector<Carry> carries;  // in order of time, between stays
};

enum class Presence { kAway, kResting, kMoving };

struct Placement {
  Presence presence = Presence::kAway;
  Se3 T_world_object;  // meaningless while away
};

Placement StateAt(const Timeline& timeline, double time_s);

// A body that changes its shape: one entry per vertex of its mesh in the scene, world frame.
struct BodyShape {
  std::vector<Eigen::Vector3f> positions;  // m
  std::vector<Eigen::Vector3f> normals;    // unit
  Se3 T_world_body;                        // between the feet (or under the seat), x forward, z up
};

// The body at a time of the story; nothing while it is away. Pure: may be called from any thread,
// in any order.
using Animation = std::function<std::optional<BodyShape>(double time_s)>;

// A scene and what happens in it. Times are seconds since the story's start.
struct World {
  Scene scene;                          // all that is ever there; the order gives the instance ids
  std::map<int, Timeline> timelines;    // by instance id; objects not listed always rest in place
  std::map<int, Animation> animations;  // by instance id
};

// The same for an object of a world (not for animated ones, whose motion is the animation's).
Placement StateAt(const World& world, int instance, double time_s);

// The world without some of its objects; the others keep their order, not their instance ids.
World WithoutObjects(World world, const std::function<bool(const SceneObject&)>& is_left_out);

// Times at which something comes to rest, leaves its place, appears or disappears, in order; the
// world's resting part is the same between two of them.
std::vector<double> TimesOfChange(const World& world);

}  // namespace cslam
