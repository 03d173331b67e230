// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/dataset/story.h"

namespace cslam {

// The six robot sequences, after the paper's PUC-USP data set: a camera 0.4 m above the floor, and
// things that vanish, move or become others while it looks elsewhere.

// What the paper's table says of a sequence, and how long its short form is.
struct RobotFigures {
  double duration_s = 0.0;
  double length_m = 0.0;
  double turning_dps = 0.0;  // mean speed of rotation
  double short_duration_s = 0.0;
};

constexpr RobotFigures kStaticFigures{110.0, 9.09, 27.08, 28.0};
constexpr RobotFigures kOneChairFigures{295.0, 18.78, 14.07, 40.0};
constexpr RobotFigures kVanishingFigures{278.0, 23.17, 24.44, 40.0};
constexpr RobotFigures kChangingFigures{195.0, 13.89, 25.36, 32.0};
constexpr RobotFigures kShiftFigures{366.0, 25.19, 16.26, 40.0};
constexpr RobotFigures kReplacingFigures{175.0, 15.49, 46.55, 40.0};

// Nothing changes.
Story MakeStaticStory(const Stage& stage, const StoryOptions& options);

// An armchair with a bear on it stands before a plain wall, is looked at from several sides, is its
// own width further along the wall when the robot comes back from a long way round, and is looked
// at in just the same way: drift over that way might explain where it is now.
Story MakeOneChairStory(const Stage& stage, const StoryOptions& options);

// A chair with a bear, an umbrella and a suitcase: first the chair and the umbrella move, then one
// thing after the other goes, until none is left.
Story MakeVanishingStory(const Stage& stage, const StoryOptions& options);

// Two equal chairs and two umbrellas; the bear changes from one chair to the other.
Story MakeChangingStory(const Stage& stage, const StoryOptions& options);

// An umbrella and a chair with a bear move, later a suitcase with monitor and mug.
Story MakeShiftStory(const Stage& stage, const StoryOptions& options);

// A chair with books, one with a bear, a suitcase with monitor and mug: an umbrella takes the place
// of the chair with the bear, then the other chair goes, books and all.
Story MakeReplacingStory(const Stage& stage, const StoryOptions& options);

}  // namespace cslam
