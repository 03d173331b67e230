// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/robot_stories.h"
#include "cslam/dataset/story.h"

#include <array>

namespace cslam {
namespace {

constexpr SequenceEntry Robot(std::string_view name, std::string_view summary,
                              const RobotFigures& figures,
                              Story (*make)(const Stage&, const StoryOptions&)) {
  return {name, summary, SensorKind::kD435i, figures.duration_s, figures.short_duration_s, make};
}

constexpr std::array kSequences{
    Robot("static", "robot: nothing changes", kStaticFigures, MakeStaticStory),
    Robot("onechair", "robot: an armchair moves along a plain wall and tempts to a false loop",
          kOneChairFigures, MakeOneChairStory),
    Robot("vanishing", "robot: things move, then go one after the other until none is left",
          kVanishingFigures, MakeVanishingStory),
    Robot("changing", "robot: a teddy bear changes from one of two equal chairs to the other",
          kChangingFigures, MakeChangingStory),
    Robot("shift", "robot: umbrella and chair move, later suitcase, monitor and mug", kShiftFigures,
          MakeShiftStory),
    Robot("replacing", "robot: a chair becomes an umbrella, another chair goes", kReplacingFigures,
          MakeReplacingStory),
};

}  // namespace

std::span<const SequenceEntry> AllSequences() {
  return kSequences;
}

}  // namespace cslam
