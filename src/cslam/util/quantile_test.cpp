// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/util/quantile.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

TEST(QuantileOf, GivesTheValueThatTheShareLiesBelow) {
  const std::vector<double> values{5.0, 1.0, 4.0, 2.0, 3.0};
  EXPECT_EQ(QuantileOf(values, 0.0), 1.0);
  EXPECT_EQ(QuantileOf(values, 0.24), 1.0) << "not interpolated";
  EXPECT_EQ(QuantileOf(values, 0.25), 2.0);
  EXPECT_EQ(QuantileOf(values, 1.0), 5.0);
}

TEST(QuantileOf, HasTwoMiddlesWhereTheNumberIsEven) {
  const std::vector<float> values{4.0F, 1.0F, 3.0F, 2.0F};
  EXPECT_EQ(QuantileOf(values, 0.5), 2.0F) << "the lower one";
  EXPECT_EQ(MedianOf(values), 3.0F) << "the upper one";
  EXPECT_EQ(MedianOf(std::vector{7.0}), 7.0);
}

TEST(InnerRange, LeavesTheOutermostOut) {
  const std::vector<double> values{5.0, 1.0, 9.0, 3.0, 7.0};
  EXPECT_EQ(InnerRange(values, 0).min, 1.0);
  EXPECT_EQ(InnerRange(values, 0).max, 9.0);
  EXPECT_EQ(InnerRange(values, 1).min, 3.0);
  EXPECT_EQ(InnerRange(values, 1).max, 7.0);
  EXPECT_EQ(InnerRange(values, 1).length(), 4.0);
  EXPECT_EQ(InnerRange(values, 1).middle(), 5.0);
  EXPECT_EQ(InnerRange(values, 2).length(), 0.0);
  EXPECT_THROW(InnerRange(values, 3), InternalError);
}

TEST(QuantileOf, NeedsValues) {
  EXPECT_THROW(QuantileOf(std::vector<double>{}, 0.5), InternalError);
  EXPECT_THROW(MedianOf(std::vector<double>{}), InternalError);
}

}  // namespace
}  // namespace cslam
