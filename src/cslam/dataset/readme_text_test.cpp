// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/readme_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cslam {
namespace {

using testing::HasSubstr;
using testing::Not;

RenderRecord SomeRecord() {
  RenderRecord record;
  record.sequence = "changing";
  record.summary = "things change";
  record.command = "changing-slam dataset render changing --out DIR --seed 7";
  record.seed = 7;
  record.fps = 30.0;
  record.num_frames = 60;
  record.story_duration_s = 195.0;
  return record;
}

TEST(FormatReadme, TellsWhatItIsHowToMakeItAgainAndWhatHappens) {
  TrueObjects objects;
  objects.objects = {{.instance = 2, .name = "chair"}, {.instance = 5, .name = "umbrella"}};
  TrueChange change{.kind = ChangeKind::kReplaced, .time_s = 1.25, .instance = 2};
  change.new_instance = 5;
  change.from = Se3(Eigen::Quaterniond::Identity(), {1, 2, 0});
  change.to = Se3(Eigen::Quaterniond::Identity(), {1.25, 2, 0});
  const std::string text =
      FormatReadme(SomeRecord(), Camera{}, objects, {.sequence = "", .changes = {change}});
  EXPECT_THAT(text, HasSubstr("things change"));
  EXPECT_THAT(text, HasSubstr("60 at 30 Hz: 2.0 s of a story of 195.0 s"));
  EXPECT_THAT(text, HasSubstr("render changing --out DIR --seed 7"));
  EXPECT_THAT(text, HasSubstr("1.25  chair replaced by umbrella"));
  EXPECT_THAT(text, HasSubstr("(1.00, 2.00, 0.00) -> (1.25, 2.00, 0.00)"));
  EXPECT_THAT(text, HasSubstr("drawn by the program itself"));
}

TEST(FormatReadme, NamesTheLicencesOfWhatItIsMadeOf) {
  RenderRecord record = SomeRecord();
  record.look = "packages";
  const std::string text = FormatReadme(record, Camera{}, {}, {});
  EXPECT_THAT(text, HasSubstr("sweethome3d-furniture"));
  EXPECT_THAT(text, HasSubstr("Nothing that rests changes its place."));
  EXPECT_THAT(text, Not(HasSubstr("drawn by the program itself")));
}

}  // namespace
}  // namespace cslam
