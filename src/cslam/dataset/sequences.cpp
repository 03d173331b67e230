// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/dynamic_stories.h"
#include "cslam/dataset/office_day_story.h"
#include "cslam/dataset/robot_stories.h"
#include "cslam/dataset/story.h"
#include "cslam/dataset/stress_stories.h"

#include <array>

namespace cslam {
namespace {

constexpr SequenceEntry Robot(std::string_view name, std::string_view summary,
                              const RobotFigures& figures,
                              Story (*make)(const Stage&, const StoryOptions&)) {
  return {name, summary, SensorKind::kD435i, figures.duration_s, figures.short_duration_s, make};
}

constexpr SequenceEntry HandHeld(std::string_view name, std::string_view summary, double duration_s,
                                 double short_duration_s,
                                 Story (*make)(const Stage&, const StoryOptions&)) {
  return {name, summary, SensorKind::kKinect, duration_s, short_duration_s, make};
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
    HandHeld("sitting_xyz", "two people sit and gesture, the camera moves along its axes",
             kSittingXyzS, kShortDynamicS, MakeSittingXyz),
    HandHeld("walking_static", "two people walk before a camera held still", kWalkingStaticS,
             kShortDynamicS, MakeWalkingStatic),
    HandHeld("walking_xyz", "two people walk, the camera moves along its axes", kWalkingXyzS,
             kShortDynamicS, MakeWalkingXyz),
    HandHeld("walking_rpy", "two people walk, the camera turns about its axes", kWalkingRpyS,
             kShortDynamicS, MakeWalkingRpy),
    HandHeld("walking_halfsphere", "two people walk, the camera moves on a half sphere",
             kWalkingHalfsphereS, kShortDynamicS, MakeWalkingHalfsphere),
    HandHeld("office_day", "people walk through an office and carry things; several visits",
             kOfficeDayS, kShortOfficeDayS, MakeOfficeDay),
    HandHeld("kidnapped", "the camera jumps to other places of a mapped room", kKidnappedS,
             kShortKidnappedS, MakeKidnapped),
    HandHeld("dark", "the light fades to 8 % and is switched off and on", kDarkS, kShortDarkS,
             MakeDark),
    HandHeld("plain_wall", "along a wall with few features", kPlainWallS, kShortPlainWallS,
             MakePlainWall),
    HandHeld("box_carried", "cartons on a cart roll past; no known class, no people", kBoxCarriedS,
             kShortBoxCarriedS, MakeBoxCarried),
    HandHeld("loop_corridor", "a ring of two rooms and two corridors", kLoopCorridorS,
             kShortLoopCorridorS, MakeLoopCorridor),
    HandHeld("twins", "two rooms that look alike to the last book", kTwinsS, kShortTwinsS,
             MakeTwins),
};

}  // namespace

std::span<const SequenceEntry> AllSequences() {
  return kSequences;
}

}  // namespace cslam
