// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/render_record.h"

#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace cslam {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

RenderRecord SomeRecord() {
  RenderRecord record;
  record.sequence = "shift";
  record.summary = "a \"summary\"";
  record.program = "0.1.0 (abc)";
  record.look = "packages";
  record.command = "changing-slam dataset render shift";
  record.seed = std::numeric_limits<std::uint64_t>::max();
  record.is_short = true;
  record.without_people = true;
  record.without = {"cart", "a \"chair\""};
  record.width_px = 320;
  record.height_px = 240;
  record.fps = 7.5;
  record.num_frames = 12;
  record.story_duration_s = 366.0;
  record.noise = SensorNoise::kD435i;
  record.people = {.min_mean_share = 0.25, .min_peak_share = 0.5, .leave_view = true};
  return record;
}

TEST(RenderRecord, ReadsBackAsWritten) {
  const TestFolder folder;
  WriteRenderRecord(folder / "render.json", SomeRecord());
  const RenderRecord read = ReadRenderRecord(folder / "render.json");
  EXPECT_THAT(Differences(read, SomeRecord()), ElementsAre());
  EXPECT_EQ(read.summary, "a \"summary\"");
  EXPECT_EQ(read.command, "changing-slam dataset render shift");
  EXPECT_EQ(read.story_duration_s, 366.0);
  EXPECT_EQ(read.people.min_mean_share, 0.25);
  EXPECT_EQ(read.people.min_peak_share, 0.5);
  EXPECT_TRUE(read.people.leave_view);
}

TEST(Differences, NameEveryParameterThatDiffers) {
  RenderRecord other = SomeRecord();
  other.seed = 1;
  other.height_px = 200;
  EXPECT_THAT(Differences(SomeRecord(), other),
              ElementsAre("the seed is 18446744073709551615 there, 1 was asked for",
                          "the size is 320x240 there, 320x200 was asked for"));
  other = SomeRecord();
  other.sequence = "static";
  other.num_frames = 3;
  other.fps = 5;
  other.noise = SensorNoise::kOff;
  other.is_short = false;
  other.without_people = false;
  other.without = {"cart"};
  other.look = "procedural";
  other.program = "0.2.0";
  EXPECT_EQ(Differences(SomeRecord(), other).size(), 9U);
}

TEST(ReadRenderRecord, TakesARecordThatLeavesNoObjectOut) {
  const TestFolder folder;
  RenderRecord whole = SomeRecord();
  whole.without.clear();
  WriteRenderRecord(folder / "render.json", whole);
  EXPECT_THAT(TestFolder::Read(folder / "render.json"), Not(HasSubstr("\"without\"")));
  EXPECT_THAT(Differences(ReadRenderRecord(folder / "render.json"), whole), ElementsAre());
}

TEST(ReadRenderRecord, NamesThePlaceOfAWrongValue) {
  const TestFolder folder;
  WriteRenderRecord(folder / "render.json", SomeRecord());
  std::string text = TestFolder::Read(folder / "render.json");
  text.replace(text.find("\"d435i\""), 7, "\"loud\"");
  folder.Write("render.json", text);
  EXPECT_THAT(MessageOf([&] { ReadRenderRecord(folder / "render.json"); }),
              HasSubstr("render.json: $.noise: expected \"off\""));
}

}  // namespace
}  // namespace cslam
