// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/actors/person_look.h"
#include "cslam/actors/skinned_body.h"

namespace cslam {

// A skeleton of average proportions, arms hanging.
Skeleton PlainSkeleton(double height_m);

// A body of rounded tubes, needing no files.
SkinnedBody MakePlainBody(const PersonLook& look);

}  // namespace cslam
