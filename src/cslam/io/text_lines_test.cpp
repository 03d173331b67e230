// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/text_lines.h"

#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cslam {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(SplitTextLines, CountsLinesThroughCommentsAndEmptyOnes) {
  const auto lines = SplitTextLines("# head\n\n  a b\n \t\n#x\nc");
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].number, 3);
  EXPECT_THAT(lines[0].fields, ElementsAre("a", "b"));
  EXPECT_EQ(lines[1].number, 6);
  EXPECT_THAT(lines[1].fields, ElementsAre("c"));
}

TEST(SplitTextLines, TakesWindowsLineEndsTabsAndAByteOrderMark) {
  const auto lines = SplitTextLines(
      "\xEF\xBB\xBF"
      "1.0\trgb/a.png  \r\n2.0 \t rgb/b.png\r\n");
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_THAT(lines[0].fields, ElementsAre("1.0", "rgb/a.png"));
  EXPECT_THAT(lines[1].fields, ElementsAre("2.0", "rgb/b.png"));
}

TEST(SplitTextLines, GivesNothingForEmptyText) {
  EXPECT_THAT(SplitTextLines(""), IsEmpty());
  EXPECT_THAT(SplitTextLines("\n\n"), IsEmpty());
}

TEST(ReadTextLines, NamesTheFileThatIsMissing) {
  const TestFolder folder;
  EXPECT_THAT(MessageOf([&] { ReadTextLines(folder / "rgb.txt"); }),
              HasSubstr("rgb.txt': No such file or directory"));
}

TEST(Excerpt, ShortensAndHidesControlCharacters) {
  EXPECT_EQ(Excerpt("ab\x01\xFF"), "ab??");
  EXPECT_EQ(Excerpt(std::string(100, 'x')), std::string(60, 'x') + "...");
}

}  // namespace
}  // namespace cslam
