// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// Bars on recordings, where the machine has them.
#include <gtest/gtest.h>

#include "dataset_support.h"

namespace cslam {
namespace {

TEST(Recording, FirstFramesOfDeskAreTrackedWithinTwoCentimetres) {
  const auto folder = test::FindRecording("tum_fr1_desk");
  if (!folder) GTEST_SKIP() << "no recordings under " << test::SharedFolder();
  const test::RecordingRun run = test::RunRecording(*folder, 200);
  EXPECT_EQ(run.num_tracked, run.num_frames);
  RecordProperty("ate_mm", std::to_string(1e3 * run.ate.statistics_m.rmse));
  EXPECT_LT(run.ate.statistics_m.rmse, 0.020);
}

TEST(Recording, EmptySceneBeforeTheCrowdIsTrackedWithin17Millimetres) {
  const auto folder = test::FindRecording("bonn_crowd_part");
  if (!folder) GTEST_SKIP() << "no recordings under " << test::SharedFolder();
  const test::RecordingRun run = test::RunRecording(*folder, 200);
  EXPECT_EQ(run.num_tracked, run.num_frames);
  RecordProperty("ate_mm", std::to_string(1e3 * run.ate.statistics_m.rmse));
  EXPECT_LT(run.ate.statistics_m.rmse, 0.017);
  EXPECT_LT(run.rpe.translation_m.max, 0.030) << "from frame to frame";
}

}  // namespace
}  // namespace cslam
