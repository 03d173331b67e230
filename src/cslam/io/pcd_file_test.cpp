// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/pcd_file.h"

#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <vector>

namespace cslam {
namespace {

using testing::HasSubstr;

TEST(WritePcd, WritesTheFinitePointsAsBinary) {
  const TestFolder folder;
  const std::vector<ColoredPoint> points = {
      {.position_m = {1.0F, 2.0F, 3.0F}, .rgb = {0x12, 0x34, 0x56}},
      {.position_m = {std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F}, .rgb = {1, 2, 3}},
      {.position_m = {-0.5F, 0.0F, 9.0F}, .rgb = {255, 0, 0}}};
  WritePcd(folder / "a.pcd", points);
  const std::string text = TestFolder::Read(folder / "a.pcd");
  EXPECT_THAT(text, HasSubstr("WIDTH 2\n"));
  EXPECT_THAT(text, HasSubstr("POINTS 2\n"));
  constexpr std::string_view kEnd = "DATA binary\n";
  const std::size_t begin = text.find(kEnd) + kEnd.size();
  ASSERT_EQ(text.size() - begin, 2U * 16U);
  float xyz[3];
  std::memcpy(xyz, text.data() + begin, sizeof(xyz));
  EXPECT_THAT(xyz, testing::ElementsAre(1.0F, 2.0F, 3.0F));
  EXPECT_EQ(text.substr(begin + 12, 4), std::string("\x56\x34\x12\0", 4));
}

}  // namespace
}  // namespace cslam
