// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/actors/person_pose.h"
#include "cslam/actors/skeleton.h"

namespace cslam {

// T_world_joint of every joint: feet and hands reach their goals as far as the limbs allow, and
// the pelvis sinks where the feet are far apart.
JointFrames SolvePose(const Skeleton& skeleton, const PersonPose& pose);

// Upright, arms hanging, at the world's origin.
PersonPose StandingPose();

}  // namespace cslam
