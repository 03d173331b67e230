// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/story.h"

namespace cslam {

// After TUM's fr3 recordings: a hand-held camera before an office desk with people in between.
Story MakeSittingXyz(const Stage& stage, const StoryOptions& options);
Story MakeWalkingStatic(const Stage& stage, const StoryOptions& options);
Story MakeWalkingXyz(const Stage& stage, const StoryOptions& options);
Story MakeWalkingRpy(const Stage& stage, const StoryOptions& options);
Story MakeWalkingHalfsphere(const Stage& stage, const StoryOptions& options);

constexpr double kSittingXyzS = 42.0;
constexpr double kWalkingStaticS = 25.0;
constexpr double kWalkingXyzS = 28.0;
constexpr double kWalkingRpyS = 30.0;
constexpr double kWalkingHalfsphereS = 35.0;
constexpr double kShortDynamicS = 18.0;  // the beginning of the same

}  // namespace cslam
