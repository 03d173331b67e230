// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/story.h"

namespace cslam {

// People walk through an office and move what is in it, in view and out of it; the camera comes
// back to every place on each of its visits (three, or two in the short form).
Story MakeOfficeDay(const Stage& stage, const StoryOptions& options);

constexpr double kOfficeDayS = 144.0;
constexpr double kShortOfficeDayS = 39.0;

}  // namespace cslam
