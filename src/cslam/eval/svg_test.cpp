// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/eval/svg.h"

#include "cslam/util/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace cslam {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(RoundTicks, AreOneTwoOrFiveTimesAPowerOfTenApart) {
  EXPECT_THAT(RoundTicks(0.0, 10.0, 5).values, ElementsAre(0.0, 2.0, 4.0, 6.0, 8.0, 10.0));
  EXPECT_THAT(RoundTicks(-0.7, 0.6, 4).values, ElementsAre(-0.5, 0.0, 0.5));
  EXPECT_THAT(RoundTicks(0.11, 0.19, 8).values.size(), 9u);
  EXPECT_THAT(RoundTicks(93.0, 320.0, 3).values, ElementsAre(100.0, 200.0, 300.0));
}

TEST(RoundTicks, HaveAsManyDecimalsAsTellThemApart) {
  EXPECT_EQ(RoundTicks(0.0, 10.0, 5).decimals, 0);
  EXPECT_EQ(RoundTicks(0.0, 1.0, 5).decimals, 1);
  EXPECT_EQ(RoundTicks(0.0, 0.1, 5).decimals, 2);
  EXPECT_EQ(RoundTicks(0.0, 6.0, 6).decimals, 0);
  EXPECT_EQ(RoundTicks(0.0, 6.0, 10).decimals, 0);  // least step 0.6, so 1
  EXPECT_EQ(RoundTicks(0.0, 7000.0, 9).decimals, 0);
}

TEST(RoundTicks, StayWithinTheRangeWhenItDoesNotBeginAtATick) {
  for (const double value : RoundTicks(-3.17, 8.43, 7).values) {
    EXPECT_GE(value, -3.17);
    EXPECT_LE(value, 8.43);
  }
}

TEST(RoundTicks, IsABugWhenTheRangeIsEmpty) {
  EXPECT_THROW(RoundTicks(1.0, 1.0, 5), InternalError);
}

TEST(EscapeXml, ReplacesWhatXmlReserves) {
  EXPECT_EQ(EscapeXml("a<b> & \"c\" 'd'\x01"), "a&lt;b&gt; &amp; &quot;c&quot; &apos;d&apos; ");
}

TEST(SvgImage, LeavesOutALineWithoutTwoPoints) {
  SvgImage svg(100.0, 50.0);
  const std::vector<Eigen::Vector2d> points = {{1.0, 2.0}, {3.0, 4.5}};
  svg.Polyline(std::span(points).first(1), "");
  EXPECT_THAT(svg.Document(), Not(HasSubstr("polyline")));
  svg.Polyline(points, R"(stroke="red")");
  EXPECT_THAT(svg.Document(),
              HasSubstr(R"(<polyline points="1.0,2.0 3.0,4.5" fill="none" stroke="red"/>)"));
  EXPECT_THAT(svg.Document(), HasSubstr(R"(viewBox="0 0 100 50")"));
}

}  // namespace
}  // namespace cslam
