// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/run_sequence.h"

#include "cslam/run/run_report.h"
#include "cslam/run/test_dataset.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

constexpr int kNumFrames = 20;
constexpr RunSettings kInline = {.execution = Execution::kInline, .rate = PlayRate::kMax};

bool Never() {
  return false;
}

RunReport RunAndReport(const MemoryDataset& dataset, const RunSettings& settings,
                       const std::function<bool()>& is_interrupted = Never) {
  const RunOutcome outcome = RunSequence(dataset, SlamOptions(), settings, {}, is_interrupted);
  RunIdentity identity;
  identity.settings = settings;
  return MakeReport(std::move(identity), dataset, outcome, ExtractTrajectories(outcome.result));
}

class RunSequenceTest : public testing::Test {
 protected:
  MemoryDataset dataset_ = RenderedDataset();
};

TEST_F(RunSequenceTest, TracksEveryFrameInlineAndThreaded) {
  for (const Execution execution : {Execution::kInline, Execution::kThreaded}) {
    const RunReport report =
        RunAndReport(dataset_, {.execution = execution, .rate = PlayRate::kMax});
    EXPECT_EQ(report.frames.input, kNumFrames);
    EXPECT_EQ(report.frames.processed, kNumFrames);
    EXPECT_EQ(report.frames.in_trajectory, kNumFrames) << report.last_reason;
    EXPECT_DOUBLE_EQ(report.frames.TrackedPercent(), 100.0);
    EXPECT_EQ(report.map.num_maps, 1U);
    EXPECT_GE(report.map.keyframes, 1U);
    EXPECT_GT(report.map.points, 100U);
    EXPECT_GE(report.mapping.keyframes_inserted, report.map.keyframes);
  }
}

TEST_F(RunSequenceTest, MeasuresTimeAndMemory) {
  const RunReport report = RunAndReport(dataset_, kInline);
  EXPECT_GT(report.cost.wall_s, 0.0);
  EXPECT_GT(report.cost.cpu_s, 0.0);
  EXPECT_GT(report.cost.peak_memory_bytes, 1'000'000U);
  EXPECT_GT(report.map.mean_keyframe_bytes, 10'000.0);
  EXPECT_TRUE(report.first_pose_ms);
  EXPECT_NEAR(report.recording_s, (kNumFrames - 1) / 30.0, 1e-6);
  EXPECT_NEAR(report.RealTimeFactor(), report.recording_s / report.cost.wall_s, 1e-9);
  ASSERT_GE(report.stages.size(), 2U);
  EXPECT_EQ(report.stages[0].count, kNumFrames);
  EXPECT_EQ(report.stages[1].name, "tracking");
  EXPECT_EQ(report.stages[1].count, kNumFrames);
}

TEST_F(RunSequenceTest, SkipsAndCountsUnreadableFramesAsInput) {
  dataset_.MakeUnreadable(5);
  const RunReport report = RunAndReport(dataset_, kInline);
  EXPECT_EQ(report.frames.input, kNumFrames);
  EXPECT_EQ(report.frames.unreadable, 1U);
  EXPECT_EQ(report.frames.in_trajectory, kNumFrames - 1U);
  EXPECT_DOUBLE_EQ(report.frames.TrackedPercent(), 95.0);
  EXPECT_EQ(report.frame_problems, std::vector<std::string>{"no such luck"});
}

TEST_F(RunSequenceTest, KeepsWhatItHasWhenInterrupted) {
  for (const Execution execution : {Execution::kInline, Execution::kThreaded}) {
    int asked = 0;
    const RunReport report =
        RunAndReport(dataset_, {.execution = execution, .rate = PlayRate::kMax},
                     [&asked] { return ++asked > 7; });
    EXPECT_TRUE(report.was_interrupted);
    EXPECT_EQ(report.frames.input, 7U);
    EXPECT_EQ(report.frames.in_trajectory, 7U);
  }
}

TEST_F(RunSequenceTest, TracksNothingAndSaysWhyWithoutDepth) {
  dataset_.RemoveDepth();
  const RunReport report = RunAndReport(dataset_, kInline);
  EXPECT_EQ(report.frames.initialising, kNumFrames);
  EXPECT_EQ(report.frames.in_trajectory, 0U);
  EXPECT_NE(report.last_reason.find("depth"), std::string::npos) << report.last_reason;
  EXPECT_FALSE(report.first_pose_ms);
}

TEST_F(RunSequenceTest, CountsEveryFrameOnceAtSensorRate) {
  const RunReport report =
      RunAndReport(dataset_, {.execution = Execution::kThreaded, .rate = PlayRate::kSensor});
  EXPECT_EQ(report.frames.processed + report.frames.dropped, kNumFrames);
  EXPECT_GE(report.cost.wall_s, report.recording_s);
}

TEST_F(RunSequenceTest, IsABugWhenInlineRunsAreToDropFrames) {
  EXPECT_THROW(RunAndReport(dataset_, {.execution = Execution::kInline, .rate = PlayRate::kSensor}),
               InternalError);
}

}  // namespace
}  // namespace cslam
