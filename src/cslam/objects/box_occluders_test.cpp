// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/box_occluders.h"

#include "cslam/objects/test_depth.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace cslam {
namespace {

using test::DrawPanel;
using test::ThumbnailOf;
using test::ViewOf;
using test::Wall;

constexpr double kStepRatio = 0.03;

// A bear 1.5 m away before the back of its chair, and the chair's arm before its right third.
struct BearOnChair {
  cv::Mat depth_m = Wall(1.8);
  Box bear = DrawPanel(depth_m, 0.0, 0.0, 1.5, 0.30, 0.40);
  Box arm = DrawPanel(depth_m, 0.30, 0.0, 1.2, 0.44, 0.12);
};

TEST(FindBoxOccluders, LeavesOutTheArmOfTheChairBeforeTheBear) {
  const BearOnChair scene;
  const DepthView view = ViewOf(scene.depth_m);
  const cv::Rect rect = ThumbnailOf(scene.bear, view.step);
  const cv::Mat found = FindBoxOccluders(view, rect, kStepRatio, {});
  ASSERT_FALSE(found.empty());
  const int middle = rect.y + rect.height / 2;
  EXPECT_EQ(found.at<std::uint8_t>(middle, rect.x + rect.width - 1), 255) << "the arm";
  EXPECT_EQ(found.at<std::uint8_t>(middle, rect.x + 2), 0) << "the bear beside it";
  EXPECT_EQ(found.at<std::uint8_t>(rect.y + 2, rect.x + rect.width / 2), 0) << "the bear above";
  EXPECT_EQ(cv::countNonZero(found), cv::countNonZero(found(rect))) << "nothing beyond the box";
}

TEST(FindBoxOccluders, KeepsAThingWhoseBoxIsTooNarrow) {
  const BearOnChair scene;
  const DepthView view = ViewOf(scene.depth_m);
  Box narrow = scene.bear;
  narrow.x_min += 12.0;
  const cv::Mat found = FindBoxOccluders(view, ThumbnailOf(narrow, view.step), kStepRatio, {});
  EXPECT_TRUE(found.empty() || found.at<std::uint8_t>(60, 76) == 0);
}

TEST(FindBoxOccluders, KeepsWhatTheEdgeOfThePictureCutsOff) {
  cv::Mat depth_m = Wall(3.0);
  const Box chair = DrawPanel(depth_m, -1.0, 0.0, 1.5, 0.6, 0.6);
  ASSERT_EQ(chair.x_min, 0.0);
  const Box wide{chair.x_min, chair.y_min, 2.2 * chair.x_max, chair.y_max};
  const DepthView view = ViewOf(depth_m);
  EXPECT_TRUE(FindBoxOccluders(view, ThumbnailOf(wide, view.step), kStepRatio, {}).empty());
}

TEST(FindBoxOccluders, LeavesTheWallBehindToOthers) {
  cv::Mat depth_m = Wall(3.0);
  const Box panel = DrawPanel(depth_m, 0.0, 0.0, 1.5, 0.3, 0.3);
  const Box wide{panel.x_min - 24.0, panel.y_min, panel.x_max + 24.0, panel.y_max};
  const DepthView view = ViewOf(depth_m);
  EXPECT_TRUE(FindBoxOccluders(view, ThumbnailOf(wide, view.step), kStepRatio, {}).empty());
}

TEST(FindBoxOccluders, FindsNothingWhenSwitchedOff) {
  const BearOnChair scene;
  const DepthView view = ViewOf(scene.depth_m);
  EXPECT_TRUE(
      FindBoxOccluders(view, ThumbnailOf(scene.bear, view.step), kStepRatio, {.enabled = false})
          .empty());
}

}  // namespace
}  // namespace cslam
