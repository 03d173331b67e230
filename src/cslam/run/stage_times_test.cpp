// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/stage_times.h"

#include <gtest/gtest.h>

#include <vector>

namespace cslam {
namespace {

TEST(Quantile, InterpolatesBetweenNeighbours) {
  const std::vector<double> sorted = {1.0, 2.0, 4.0, 8.0};
  EXPECT_DOUBLE_EQ(Quantile(sorted, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(Quantile(sorted, 0.5), 3.0);
  EXPECT_DOUBLE_EQ(Quantile(sorted, 0.95), 7.4);  // numpy.quantile([1, 2, 4, 8], 0.95)
  EXPECT_DOUBLE_EQ(Quantile(sorted, 1.0), 8.0);
}

TEST(Quantile, IsZeroWithoutValues) {
  EXPECT_EQ(Quantile({}, 0.5), 0.0);
}

TEST(SummariseTimes, SortsFirst) {
  const TimeSummary summary = SummariseTimes({5.0, 1.0, 3.0});
  EXPECT_DOUBLE_EQ(summary.median_ms, 3.0);
  EXPECT_DOUBLE_EQ(summary.max_ms, 5.0);
  EXPECT_DOUBLE_EQ(summary.total_ms, 9.0);
}

TEST(SummariseStages, SumsStepsPerFrameAndKeepsTheirOrder) {
  RunLog log;
  log.frames.resize(2);
  log.frames[0].times = {{"extract", 2.0, 1.0}};
  log.frames[1].times = {{"extract", 4.0, 3.0}, {"predict", 10.0, 1.0}};
  log.mapper_steps = {{{"insert", 1.0, 1.0}, {"publish", 2.0, 1.0}, {"publish", 4.0, 1.0}}};
  const auto stages = SummariseStages(log, std::vector<LapTime>{{7.0, 6.0}});
  ASSERT_EQ(stages.size(), 7U);
  EXPECT_EQ(stages[0].name, "load");
  EXPECT_DOUBLE_EQ(stages[0].cpu.median_ms, 6.0);
  EXPECT_EQ(stages[1].name, "tracking");
  EXPECT_DOUBLE_EQ(stages[1].wall.median_ms, 8.0);  // of 2 and 14
  EXPECT_DOUBLE_EQ(stages[1].cpu.max_ms, 4.0);
  EXPECT_EQ(stages[2].name, "tracking.extract");
  EXPECT_EQ(stages[3].name, "tracking.predict");
  EXPECT_EQ(stages[3].count, 1U);
  EXPECT_EQ(stages[4].name, "mapping");
  EXPECT_DOUBLE_EQ(stages[4].wall.total_ms, 7.0);
  EXPECT_EQ(stages[6].name, "mapping.publish");
  EXPECT_EQ(stages[6].count, 2U);
}

TEST(SummariseStages, IsEmptyWhenNothingRan) {
  EXPECT_TRUE(SummariseStages(RunLog(), {}).empty());
}

}  // namespace
}  // namespace cslam
