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
  const auto found = SegmentDetections(view, {Of(kChair, chair), Of(kBear, bear)}, {});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_GT(Coverage(found[0].region, chair, view.step), 0.7);
  EXPECT_LT(Coverage(found[0].region, bear, view.step), 0.1) << "that is the bear";
  EXPECT_GT(Coverage(found[1].region, bear, view.step), 0.9);
}

TEST(SegmentDetections, GivesAPersonBeforeAThingAllThatIsThePersons) {
  cv::Mat depth_m = Wall(4.0);
  const Box chair = DrawPanel(depth_m, 0.2, 0.0, 2.2, 0.8, 0.9);
  const Box person = DrawPanel(depth_m, 0.0, 0.0, 2.0, 0.4, 1.5);
  const DepthView view = ViewOf(depth_m);
  const auto found = SegmentDetections(view, {Of(kChair, chair), Of(kPersonClass, person)}, {});
  EXPECT_GT(Coverage(found[1].region, person, view.step), 0.9);
  cv::Mat both;
  cv::bitwise_and(found[0].region.mask, found[1].region.mask, both);
  EXPECT_EQ(cv::countNonZero(both), 0);
}

TEST(SegmentDetections, LeavesOutAPieceOfAThingOfTheSameName) {
  cv::Mat depth_m = Wall(4.0);
  const Box chair = DrawPanel(depth_m, 0.0, 0.0, 2.0, 0.8, 0.9);
  const Box back{chair.x_min, chair.y_min, chair.x_min + 0.4 * chair.width(), chair.y_max};
  const DepthView view = ViewOf(depth_m);
  const auto found = SegmentDetections(view, {Of(kChair, back), Of(kChair, chair)}, {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_GT(Coverage(found[0].region, chair, view.step), 0.9);
}

TEST(SegmentDetections, KeepsAThingInFrontOfAnotherOfTheSameName) {
  cv::Mat depth_m = Wall(4.0);
  const Box chair = DrawPanel(depth_m, 0.0, 0.0, 2.0, 0.8, 0.9);
  const Box nearer = DrawPanel(depth_m, -0.1, 0.0, 1.5, 0.3, 0.6);  // covers most of it
  const auto found =
      SegmentDetections(ViewOf(depth_m), {Of(kChair, chair), Of(kChair, nearer)}, {});
  EXPECT_EQ(found.size(), 2U);
}

TEST(SegmentDetections, KeepsTwoThingsInABoxAroundThemBoth) {
  cv::Mat depth_m = Wall(4.0);
  const Box both = DrawPanel(depth_m, 0.0, 0.0, 2.0, 1.2, 0.6);
  const double middle = 0.5 * (both.x_min + both.x_max);
  const Box left{both.x_min, both.y_min, middle, both.y_max};
  const Box right{middle, both.y_min, both.x_max, both.y_max};
  const auto found = SegmentDetections(ViewOf(depth_m),
                                       {Of(kChair, both), Of(kChair, left), Of(kChair, right)}, {});
  EXPECT_EQ(found.size(), 3U);
}

TEST(SegmentDetections, IsEmptyWhereThereIsNoDepth) {
  const auto found =
      SegmentDetections(ViewOf(Wall(0.0)), {Of(kChair, {100.0, 100.0, 200.0, 200.0})}, {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].region.empty());
}

}  // namespace
}  // namespace cslam
