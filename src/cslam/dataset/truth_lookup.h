// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/truth_files.h"
#include "cslam/sim/world.h"
#include "cslam/util/stamp.h"

#include <Eigen/Core>

namespace cslam {

// Questions to objects.json. Times are seconds since the sequence's start.

inline double TimeOf(const TrueObjects& objects, Stamp stamp) {
  return SecondsBetween(stamp, objects.start);
}

// Null if there is no such instance.
const TrueObject* FindObject(const TrueObjects& objects, int instance);

// Intervals hold from_s <= t < to_s; moving poses are interpolated.
Placement StateAt(const TrueObject& object, double time_s);

// Whether an interval begins or ends within 1 ms of the time: too near to be judged.
bool IsAtBoundary(const TrueObject& object, double time_s);

// Whether what shows the instance at both times shows it at the same place, at rest. The room (0)
// always does, people and unknown instances never do.
bool IsSamePlace(const TrueObjects& objects, int instance, double time_a_s, double time_b_s);

// How far outside the object's box a point of the world lies, in m; 0 inside.
double DistanceToBox(const TrueObject& object, const Se3& T_world_object,
                     const Eigen::Vector3d& p_world);

}  // namespace cslam
