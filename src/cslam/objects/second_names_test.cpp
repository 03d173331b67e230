// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/second_names.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

constexpr int kChair = 56;
constexpr int kSuitcase = 28;
constexpr double kMaxIou = 0.8;
const Box kBox{100.0, 100.0, 200.0, 200.0};

std::vector<int> ClassesLeft(std::vector<Detection> detections) {
  std::vector<int> classes;
  for (const Detection& left : WithoutSecondNames(std::move(detections), kMaxIou))
    classes.push_back(left.class_id);
  return classes;
}

TEST(SecondNamesTest, TheBetterNameOfOneBoxStays) {
  const Box nearly{101.0, 100.0, 200.0, 203.0};
  EXPECT_EQ(ClassesLeft({{kChair, 0.4, kBox, {}}, {kSuitcase, 0.5, nearly, {}}}),
            std::vector{kSuitcase});
  EXPECT_EQ(ClassesLeft({{kChair, 0.5, kBox, {}}, {kSuitcase, 0.5, nearly, {}}}),
            std::vector{kChair})
      << "of equals the first";
}

TEST(SecondNamesTest, WhatIsDroppedDropsNothing) {
  const Box right{108.0, 100.0, 208.0, 200.0};  // overlaps kBox by 0.85, as the next one does it
  const Box farther{115.0, 100.0, 215.0, 200.0};
  EXPECT_EQ(
      ClassesLeft({{kChair, 0.6, kBox, {}}, {kSuitcase, 0.5, right, {}}, {62, 0.4, farther, {}}}),
      (std::vector{kChair, 62}));
}

TEST(SecondNamesTest, WhatSitsOnAThingStays) {
  const Box smaller{120.0, 100.0, 180.0, 160.0};
  EXPECT_EQ(ClassesLeft({{kChair, 0.5, kBox, {}}, {kSuitcase, 0.4, smaller, {}}}).size(), 2U);
}

TEST(SecondNamesTest, PeopleKeepTheirBoxAndLeaveOthersTheirs) {
  EXPECT_EQ(ClassesLeft({{kPersonClass, 0.4, kBox, {}}, {kChair, 0.5, kBox, {}}}).size(), 2U);
  EXPECT_EQ(ClassesLeft({{kPersonClass, 0.6, kBox, {}}, {kChair, 0.5, kBox, {}}}).size(), 2U);
}

TEST(SecondNamesTest, TwoOfOneNameAreLeftToTheDetector) {
  EXPECT_EQ(ClassesLeft({{kChair, 0.4, kBox, {}}, {kChair, 0.5, kBox, {}}}).size(), 2U);
}

}  // namespace
}  // namespace cslam
