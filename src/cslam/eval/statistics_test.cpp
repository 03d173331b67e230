// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/eval/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace cslam {
namespace {

TEST(Summarise, GivesTheTextbookValuesWhenErrorsAreKnown) {
  const std::vector<double> errors = {3.0, 1.0, 4.0, 2.0};
  const ErrorStatistics s = Summarise(errors);
  EXPECT_EQ(s.count, 4u);
  EXPECT_DOUBLE_EQ(s.sse, 30.0);
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(7.5));
  EXPECT_DOUBLE_EQ(s.mean, 2.5);
  EXPECT_DOUBLE_EQ(s.median, 2.5);
  EXPECT_DOUBLE_EQ(s.std, std::sqrt(1.25));
  EXPECT_DOUBLE_EQ(s.min, 1.0);
  EXPECT_DOUBLE_EQ(s.max, 4.0);
  EXPECT_EQ(s.max_index, 2u);
}

TEST(Summarise, TakesTheMiddleAsMedianWhenTheCountIsOdd) {
  const std::vector<double> errors = {9.0, 1.0, 2.0};
  EXPECT_DOUBLE_EQ(Summarise(errors).median, 2.0);
}

TEST(Summarise, IsAllZeroWhenThereAreNoErrors) {
  const ErrorStatistics s = Summarise({});
  EXPECT_EQ(s.count, 0u);
  EXPECT_EQ(s.rmse, 0.0);
  EXPECT_EQ(s.median, 0.0);
}

}  // namespace
}  // namespace cslam
