// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/story.h"

namespace cslam {

// The camera jumps to another place of the mapped room: at once, and later behind a covered lens.
Story MakeKidnapped(const Stage& stage, const StoryOptions& options);
// The light fades to 8 % and returns; later it is switched off and on.
Story MakeDark(const Stage& stage, const StoryOptions& options);
// Along a wall with next to nothing on it, between two furnished corners.
Story MakePlainWall(const Stage& stage, const StoryOptions& options);
// Cartons on a cart roll past the camera and stop before it; no class, no people.
Story MakeBoxCarried(const Stage& stage, const StoryOptions& options);
// Two rooms and two corridors form a ring; the first places are seen again at its end.
Story MakeLoopCorridor(const Stage& stage, const StoryOptions& options);
// Two rooms alike to the last book, side by side at one corridor, are looked at in the same way.
Story MakeTwins(const Stage& stage, const StoryOptions& options);

constexpr double kKidnappedS = 48.0;
constexpr double kShortKidnappedS = 34.0;
constexpr double kDarkS = 48.0;
constexpr double kShortDarkS = 30.0;
constexpr double kPlainWallS = 76.0;
constexpr double kShortPlainWallS = 36.0;
constexpr double kBoxCarriedS = 32.0;
constexpr double kShortBoxCarriedS = 18.0;
constexpr double kLoopCorridorS = 104.0;
constexpr double kShortLoopCorridorS = 39.0;
constexpr double kTwinsS = 66.0;
constexpr double kShortTwinsS = 39.0;

}  // namespace cslam
