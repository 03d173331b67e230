// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// `dataset check` on recordings, where the machine has them.
#include "cslam/dataset/sequence_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dataset_support.h"

namespace cslam {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class RecordingCheck : public testing::TestWithParam<const char*> {};

TEST_P(RecordingCheck, PassesWithDepthNearThePoses) {
  const auto folder = test::FindRecording(GetParam());
  if (!folder) GTEST_SKIP() << "no recordings under " << test::SharedFolder();
  const SequenceCheck check = CheckSequence(*folder, {.num_samples = 30});
  EXPECT_THAT(check.errors, IsEmpty());
  EXPECT_THAT(check.warnings, Not(Contains(HasSubstr("disagree"))));
  EXPECT_THAT(check.skipped, Contains(HasSubstr("story not checked")));
  ASSERT_TRUE(check.reprojection);
  EXPECT_GT(check.reprojection->pairs.size(), 20U);
  EXPECT_LT(check.reprojection->all.median_relative, 0.015);
}

INSTANTIATE_TEST_SUITE_P(All, RecordingCheck, testing::Values("tum_fr1_desk", "bonn_crowd_part"));

TEST(RecordingCheck, WarnsOfAWrongDepthScale) {
  const auto folder = test::FindRecording("tum_fr1_desk");
  if (!folder) GTEST_SKIP() << "no recordings under " << test::SharedFolder();
  SequenceCheckOptions options;
  options.camera.depth_units_per_m = 1000.0;
  options.num_samples = 30;
  EXPECT_THAT(CheckSequence(*folder, options).warnings, Contains(HasSubstr("depth scale")));
}

}  // namespace
}  // namespace cslam
