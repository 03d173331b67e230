// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/actors/person_pose.h"
#include "cslam/actors/skinned_body.h"

namespace cslam {

class PersonModel {
 public:
  SkinnedBody body;
};

// The body in a pose; world frame.
BodyShape ShapeOf(const PersonModel& model, const PersonPose& pose);

}  // namespace cslam
