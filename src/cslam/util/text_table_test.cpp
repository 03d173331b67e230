// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/util/text_table.h"

#include "cslam/util/check.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

TEST(TextTable, LinesUpNamesAndValuesWhenUntitled) {
  TextTable table;
  table.AddRow({"frames", "573"});
  table.AddRow({"tracked", "100 %"});
  EXPECT_EQ(table.Text(), "frames   573\ntracked  100 %\n");
}

TEST(TextTable, PutsTitlesAndARuleOnTopWhenTitled) {
  TextTable table({{"stage"}, {"ms", TextAlign::kRight}});
  table.AddRow({"orb", "3.5"});
  table.AddRow({"tracking", "12.5"});
  EXPECT_EQ(table.Text(),
            "stage       ms\n"
            "--------------\n"
            "orb        3.5\n"
            "tracking  12.5\n");
}

TEST(TextTable, CountsCodePointsWhenCellsAreUtf8) {
  TextTable table;
  table.AddRow({"σ", "1"});
  table.AddRow({"ab", "2"});
  EXPECT_EQ(table.Text(), "σ   1\nab  2\n");
}

TEST(TextTable, DrawsARuleAndIndentsWhenAsked) {
  TextTable table;
  table.AddRow({"a", "b"});
  table.AddRule();
  table.AddRow({"c"});
  EXPECT_EQ(table.Text(2), "  a  b\n  ----\n  c\n");
}

TEST(TextTable, IsABugWhenARowIsTooLong) {
  TextTable table;
  EXPECT_THROW(table.AddRow({"1", "2", "3"}), InternalError);
}

}  // namespace
}  // namespace cslam
