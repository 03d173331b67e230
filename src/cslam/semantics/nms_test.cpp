// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/semantics/nms.h"

#include <gtest/gtest.h>

#include <limits>

namespace cslam {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Detection Make(int class_id, double score, const Box& box) {
  return {.class_id = class_id, .score = score, .box = box, .mask = {}};
}

TEST(SuppressNonMaxima, KeepsTheBestOfOverlappingBoxesOfAClass) {
  const auto kept =
      SuppressNonMaxima({Make(0, 0.6, {10, 10, 50, 90}), Make(0, 0.9, {12, 10, 52, 90}),
                         Make(0, 0.7, {200, 10, 250, 90})},
                        0.5, 100);
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_EQ(kept[0].score, 0.9);
  EXPECT_EQ(kept[1].score, 0.7);
}

TEST(SuppressNonMaxima, KeepsOverlappingBoxesOfDifferentClasses) {
  const auto kept = SuppressNonMaxima(
      {Make(0, 0.6, {10, 10, 50, 90}), Make(56, 0.9, {10, 10, 50, 90})}, 0.5, 100);
  EXPECT_EQ(kept.size(), 2U);
}

TEST(SuppressNonMaxima, ComparesOverlapWithTheLimit) {
  const std::vector<Detection> two = {Make(0, 0.9, {0, 0, 10, 10}), Make(0, 0.8, {0, 0, 10, 5})};
  EXPECT_EQ(SuppressNonMaxima(two, 0.51, 100).size(), 2U);  // their IoU is 0.5
  EXPECT_EQ(SuppressNonMaxima(two, 0.49, 100).size(), 1U);
}

TEST(SuppressNonMaxima, ABoxThatWasSuppressedSuppressesNothing) {
  const auto kept = SuppressNonMaxima(
      {Make(0, 0.9, {0, 0, 10, 10}), Make(0, 0.8, {4, 0, 14, 10}), Make(0, 0.7, {8, 0, 18, 10})},
      0.3, 100);
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_EQ(kept[1].score, 0.7);
}

TEST(SuppressNonMaxima, DropsWhatIsNotFiniteOrEmpty) {
  const Box good{0, 0, 10, 10};
  const auto kept = SuppressNonMaxima(
      {Make(0, kNan, good), Make(0, kInfinity, good), Make(0, 0.9, {kNan, 0, 10, 10}),
       Make(0, 0.9, {0, 0, kInfinity, 10}), Make(0, 0.9, {10, 0, 5, 10}), Make(0, 0.3, good)},
      0.5, 100);
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept[0].score, 0.3);
}

TEST(SuppressNonMaxima, KeepsTheOrderOfEqualScoresAndTheLimit) {
  const auto kept = SuppressNonMaxima(
      {Make(3, 0.5, {0, 0, 10, 10}), Make(1, 0.5, {0, 0, 10, 10}), Make(2, 0.5, {0, 0, 10, 10})},
      0.5, 2);
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_EQ(kept[0].class_id, 3);
  EXPECT_EQ(kept[1].class_id, 1);
}

}  // namespace
}  // namespace cslam
