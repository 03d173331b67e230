// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/benchmark/plan.h"

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
