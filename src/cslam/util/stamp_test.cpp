// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/util/stamp.h"

#include "cslam/util/check.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace cslam {
namespace {

TEST(ParseStamp, ReadsDecimalsExactly) {
  EXPECT_EQ(ParseStamp("1305031453.359684"), Stamp{1'305'031'453'359'684'000});
  EXPECT_EQ(ParseStamp("1305031453.000000001"), Stamp{1'305'031'453'000'000'001});
  EXPECT_EQ(ParseStamp("1548339819.89427"), Stamp{1'548'339'819'894'270'000});
  EXPECT_EQ(ParseStamp("0"), Stamp{0});
  EXPECT_EQ(ParseStamp("7."), Stamp{7'000'000'000});
  EXPECT_EQ(ParseStamp(".5"), Stamp{500'000'000});
  EXPECT_EQ(ParseStamp("+2.5"), Stamp{2'500'000'000});
  EXPECT_EQ(ParseStamp("-2.5"), Stamp{-2'500'000'000});
}

TEST(ParseStamp, RoundsTheTenthDecimal) {
  EXPECT_EQ(ParseStamp("0.0000000004"), Stamp{0});
  EXPECT_EQ(ParseStamp("0.0000000005"), Stamp{1});
  EXPECT_EQ(ParseStamp("0.9999999999"), Stamp{1'000'000'000});
  EXPECT_EQ(ParseStamp("0.00000000049999"), Stamp{0});
}

TEST(ParseStamp, ReadsScientificNotation) {
  EXPECT_EQ(ParseStamp("1.5e+03"), Stamp{1'500'000'000'000});
  EXPECT_EQ(ParseStamp("25E-1"), Stamp{2'500'000'000});
}

TEST(ParseStamp, RefusesWhatIsNoNumberOfSeconds) {
  for (const char* text :
       {"",      "-",   "+",  ".",     "-.",   "abc",         "1,5",
        "1.2.3", "1 2", " 1", "1 ",    "nan",  "inf",         "0x10",
        "--1",   "1e",  "e5", "1e400", "1.0s", "10000000000", "99999999999999999999",
        "9.9e9"}) {
    EXPECT_EQ(ParseStamp(text), std::nullopt) << "'" << text << "'";
  }
}

TEST(FormatStamp, RoundsToTheDecimalsAskedFor) {
  const Stamp stamp{1'305'031'453'359'684'500};
  EXPECT_EQ(FormatStamp(stamp, 9), "1305031453.359684500");
  EXPECT_EQ(FormatStamp(stamp, 6), "1305031453.359685");
  EXPECT_EQ(FormatStamp(stamp, 1), "1305031453.4");
  EXPECT_EQ(FormatStamp(stamp, 0), "1305031453");
  EXPECT_EQ(FormatStamp(Stamp{999'999'999}, 3), "1.000");
  EXPECT_EQ(FormatStamp(Stamp{1'000'000}, 6), "0.001000");
}

TEST(FormatStamp, KeepsTheSignExceptOfZero) {
  EXPECT_EQ(FormatStamp(Stamp{-1'500'000'000}, 3), "-1.500");
  EXPECT_EQ(FormatStamp(Stamp{-1}, 6), "0.000000");
}

TEST(FormatStamp, RefusesDecimalsBeyondNanoseconds) {
  EXPECT_THROW(FormatStamp(Stamp{0}, 10), InternalError);
  EXPECT_THROW(FormatStamp(Stamp{0}, -1), InternalError);
}

TEST(FormatStamp, IsUndoneByParseStamp) {
  for (const std::int64_t ns :
       {std::int64_t{0}, std::int64_t{1}, std::int64_t{-1}, std::int64_t{123'456'789},
        std::int64_t{-987'654'321'012}, std::int64_t{1'700'000'000'000'000'001}}) {
    EXPECT_EQ(ParseStamp(FormatStamp(Stamp{ns}, 9)), Stamp{ns}) << ns;
  }
}

TEST(Stamp, OrdersAndSubtractsExactly) {
  const Stamp early{1'305'031'453'000'000'000};
  const Stamp late = early + 1;
  EXPECT_LT(early, late);
  EXPECT_EQ(SecondsBetween(early + 250'000'000, early), 0.25);
  EXPECT_EQ(SecondsBetween(early, early + 250'000'000), -0.25);
}

}  // namespace
}  // namespace cslam
