// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/actors/person.h"
#include "cslam/geometry/se3.h"
#include "cslam/sim/world.h"

namespace cslam {

// Somebody takes an object from one place to another.
struct Errand {
  double take_s = 0.0;  // the object leaves its place
  double put_s = 0.0;   // and rests in the new one
  Se3 T_world_from;
  Se3 T_world_to;
};

// The way of what `holder`, a motion made by Carrying(), takes: lifted, held, set down.
Carry CarryOf(const PersonMotion& holder, const Errand& errand);

// An object that is taken once and rests before and after.
Timeline TakenOnce(const PersonMotion& holder, const Errand& errand);

// An object that is somewhere else from a time on, without anybody seen to take it.
Timeline MovedAt(double time_s, const Se3& T_world_from, const Se3& T_world_to);
Timeline RemovedAt(double time_s, const Se3& T_world_object);
Timeline AddedAt(double time_s, const Se3& T_world_object);

// How long lifting and setting down take.
constexpr double kLiftS = 1.2;

}  // namespace cslam
