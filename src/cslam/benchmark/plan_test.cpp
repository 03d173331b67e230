// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/benchmark/plan.h"

#include "cslam/dataset/render_record.h"
#include "cslam/dataset/sequence_folder.h"
#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cslam {
namespace {

using testing::HasSubstr;

TEST(ResolveSequences, KnowsTheSixAndSaysWhatItDoesNotKnow) {
  EXPECT_EQ(ResolveSequences({"six"}), SixSequences());
  EXPECT_EQ(ResolveSequences({"all"}).size(), 18U);
  EXPECT_EQ(ResolveSequences({"twins", "static"}), (std::vector<std::string>{"twins", "static"}));
  EXPECT_THROW(ResolveSequences({"twins", "twins"}), Error);
  try {
    ResolveSequences({"onechiar"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("onechair"));
  }
}

TEST(MakePlan, RunsEveryRenderingWithEachLayerAsOftenAsAsked) {
  const BenchmarkPlan plan = MakePlan({.folder = "b",
                                       .sequences = {"static", "shift"},
                                       .is_short = true,
                                       .first_seed = 7,
                                       .num_seeds = 2,
                                       .num_repeats = 3});
  ASSERT_EQ(plan.data.size(), 4U);
  EXPECT_EQ(plan.runs.size(), 4U * 2U * 3U);
  EXPECT_EQ(plan.data[1].folder, "b/data/static-short-8");
  EXPECT_EQ(plan.runs[0].folder, "b/runs/static-short-7-objects_on-1");
  EXPECT_EQ(plan.runs[1].folder, "b/runs/static-short-7-objects_off-1");
  EXPECT_EQ(plan.Sequences(), (std::vector<std::string>{"static", "shift"}));
}

class RenderingStateTest : public testing::Test {
 protected:
  RenderingStateTest() {
    request_.num_frames = 20;
    request_.is_short = true;
    RenderRecord record;
    record.sequence = data_.sequence;
    record.seed = data_.seed;
    record.program = "program 1";
    record.is_short = true;
    record.width_px = 640;
    record.height_px = 480;
    record.fps = 30.0;
    record.num_frames = 20;
    record.noise = SensorNoise::kD435i;
    WriteRenderRecord(folder_.path() / kRenderFile, record);
  }
  RenderingState State(std::string_view program, std::string_view look = "") const {
    return StateOf(data_, request_, look, program);
  }

  const TestFolder folder_;
  const PlannedData data_{"static", 3, folder_.path()};
  RenderRequest request_;
};

TEST_F(RenderingStateTest, GoesOnWithWhatTheSameProgramBegan) {
  EXPECT_EQ(State("program 1"), RenderingState::kUnfinished);
  EXPECT_EQ(State("program 2"), RenderingState::kOutdated);
  EXPECT_EQ(StateOf({"static", 3, folder_.path() / "none"}, request_, "", "program 1"),
            RenderingState::kUnfinished);
}

TEST_F(RenderingStateTest, TakesWhatIsCompleteFromAnyProgram) {
  folder_.Write(kCameraFile, "");
  EXPECT_EQ(State("program 2"), RenderingState::kComplete);
}

TEST_F(RenderingStateTest, RefusesARenderingOfSomethingElse) {
  folder_.Write(kCameraFile, "");
  request_.width = 320;
  request_.height = 240;
  EXPECT_THAT(MessageOf([&] { State("program 1"); }),
              HasSubstr("the size is 640x480 there, 320x240 was asked for"));
  request_ = {};
  request_.num_frames = 20;
  request_.is_short = true;
  EXPECT_EQ(State("program 1", "procedural"), RenderingState::kComplete);
  EXPECT_THAT(MessageOf([&] { State("program 1", "packages"); }),
              HasSubstr("the look is procedural there, packages was asked for"));
}

TEST(IsRunDone, TakesOnlyCompleteRunsOfTheSameProgramAndArguments) {
  const TestFolder folder;
  const std::vector<std::string> arguments{"run", "x"};
  EXPECT_FALSE(IsRunDone(folder.path(), "c1", arguments));
  folder.Write("run.json", R"({"commit": "c1", "arguments": ["run", "x"],
                               "was_interrupted": false})");
  EXPECT_TRUE(IsRunDone(folder.path(), "c1", arguments));
  EXPECT_FALSE(IsRunDone(folder.path(), "c2", arguments));
  EXPECT_FALSE(IsRunDone(folder.path(), "c1", {"run", "y"}));
  folder.Write("run.json", R"({"commit": "c1", "arguments": ["run", "x"],
                               "was_interrupted": true})");
  EXPECT_FALSE(IsRunDone(folder.path(), "c1", arguments));
}

}  // namespace
}  // namespace cslam
