// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/detection_regions.h"

#include "cslam/objects/test_depth.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace cslam {
namespace {

using test::Coverage;
using test::DrawPanel;
using test::ViewOf;
using test::Wall;

constexpr int kChair = 56;
constexpr int kBear = 77;

Detection Of(int class_id, const Box& box) {
  return {.class_id = class_id, .score = 0.9, .box = box, .mask = {}};
}

TEST(SegmentDetections, LeavesWhatSitsOnAThingOutOfIt) {
  cv::Mat depth_m = Wall(4.0);
  const Box chair = DrawPanel(depth_m, 0.0, 0.0, 2.0, 0.8, 0.9);
  const Box bear = DrawPanel(depth_m, 0.0, 0.0, 1.9, 0.3, 0.3);
  const DepthView view = ViewOf(depth_m);
  const auto regions = SegmentDetections(view, {Of(kChair, chair), Of(kBear, bear)}, {});
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_GT(Coverage(regions[0], chair, view.step), 0.7);
  EXPECT_LT(Coverage(regions[0], bear, view.step), 0.1) << "that is the bear";
  EXPECT_GT(Coverage(regions[1], bear, view.step), 0.9);
}

TEST(SegmentDetections, GivesAPersonBeforeAThingAllThatIsThePersons) {
  cv::Mat depth_m = Wall(4.0);
  const Box chair = DrawPanel(depth_m, 0.2, 0.0, 2.2, 0.8, 0.9);
  const Box person = DrawPanel(depth_m, 0.0, 0.0, 2.0, 0.4, 1.5);
  const DepthView view = ViewOf(depth_m);
  const auto regions = SegmentDetections(view, {Of(kChair, chair), Of(kPersonClass, person)}, {});
  EXPECT_GT(Coverage(regions[1], person, view.step), 0.9);
  cv::Mat both;
  cv::bitwise_and(regions[0].mask, regions[1].mask, both);
  EXPECT_EQ(cv::countNonZero(both), 0);
}

TEST(SegmentDetections, IsEmptyWhereThereIsNoDepth) {
  const auto regions =
      SegmentDetections(ViewOf(Wall(0.0)), {Of(kChair, {100.0, 100.0, 200.0, 200.0})}, {});
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_TRUE(regions[0].empty());
}

}  // namespace
}  // namespace cslam
