// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/box_background.h"

#include "cslam/objects/test_depth.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace cslam {
namespace {

using test::DrawPanel;
using test::ThumbnailOf;
using test::ViewOf;
using test::Wall;

// Floor 1.2 m below a level camera, and a wall at 4 m.
cv::Mat FloorAndWall() {
  cv::Mat depth_m = Wall(4.0);
  const Camera camera = test::SceneCamera();
  for (int v = static_cast<int>(camera.cy) + 1; v < depth_m.rows; ++v) {
    const auto z = static_cast<float>(1.2 * camera.fy / (v - camera.cy));
    for (int u = 0; u < depth_m.cols; ++u)
      depth_m.at<float>(v, u) = std::min(depth_m.at<float>(v, u), z);
  }
  return depth_m;
}

TEST(FindBoxBackground, LeavesOutTheWallBehindAndKeepsTheThing) {
  cv::Mat depth_m = Wall(4.0);
  const Box panel = DrawPanel(depth_m, 0.0, 0.0, 3.7, 0.6, 0.6);
  const Box wide{panel.x_min - 16, panel.y_min - 16, panel.x_max + 16, panel.y_max + 16};
  const DepthView view = ViewOf(depth_m);
  const cv::Rect rect = ThumbnailOf(wide, view.step);
  const BoxBackground found = FindBoxBackground(view, rect, {}, {});
  ASSERT_FALSE(found.mask.empty());
  EXPECT_FALSE(found.is_flat);
  EXPECT_EQ(found.mask.at<std::uint8_t>(60, 80), 0) << "the middle of the panel";
  EXPECT_EQ(found.mask.at<std::uint8_t>(rect.y + 1, rect.x + 1), 255) << "wall inside the box";
}

TEST(FindBoxBackground, FindsFloorAndWallAtOnce) {
  cv::Mat depth_m = FloorAndWall();
  const Box panel = DrawPanel(depth_m, 0.0, 0.8, 2.5, 0.6, 0.8);  // stands on the floor
  const DepthView view = ViewOf(depth_m);
  const BoxBackground found =
      FindBoxBackground(view, ThumbnailOf(panel, view.step), {}, BoxBackgroundOptions{});
  ASSERT_FALSE(found.mask.empty());
  const cv::Rect rect = ThumbnailOf(panel, view.step);
  const cv::Mat inside = found.mask(rect);
  EXPECT_LT(cv::countNonZero(inside), 0.1 * rect.area());
  EXPECT_EQ(found.mask.at<std::uint8_t>(rect.y + rect.height / 2, rect.x - 2), 255);
}

TEST(FindBoxBackground, CallsFlatWhatLiesInThePlaneAround) {
  const DepthView view = ViewOf(Wall(3.0));
  const BoxBackground found = FindBoxBackground(view, {60, 40, 40, 40}, {}, {});
  EXPECT_TRUE(found.is_flat);
  EXPECT_TRUE(found.mask.empty()) << "or nothing would be left of a picture on the wall";
  EXPECT_TRUE(found.is_on_wall);
}

TEST(FindBoxBackground, TellsTheFloorFromAWall) {
  const DepthView view = ViewOf(FloorAndWall());
  const BoxBackground rug = FindBoxBackground(view, {60, 100, 40, 12}, {}, {});
  ASSERT_TRUE(rug.is_flat);
  EXPECT_FALSE(rug.is_on_wall);
}

TEST(FindBoxBackground, FindsNothingWithoutDepthWithoutRingOrWhenSwitchedOff) {
  const DepthView blank = ViewOf(Wall(0.0));
  EXPECT_TRUE(FindBoxBackground(blank, {60, 40, 40, 40}, {}, {}).mask.empty());
  EXPECT_FALSE(FindBoxBackground(blank, {60, 40, 40, 40}, {}, {}).is_flat);
  const DepthView wall = ViewOf(Wall(3.0));
  EXPECT_TRUE(FindBoxBackground(wall, {0, 0, 160, 120}, {}, {}).mask.empty());
  EXPECT_FALSE(FindBoxBackground(wall, {60, 40, 40, 40}, {}, {.enabled = false}).is_flat);
}

TEST(FindBoxBackground, TakesNoPartInWhatIsExcluded) {
  const DepthView view = ViewOf(Wall(3.0));
  const cv::Mat all(view.depth_mm.size(), CV_8UC1, cv::Scalar(255));
  const BoxBackground found = FindBoxBackground(view, {60, 40, 40, 40}, all, {});
  EXPECT_TRUE(found.mask.empty());
  EXPECT_FALSE(found.is_flat);
}

TEST(FindBoxBackground, GivesTheSameAnswerTwice) {
  cv::Mat depth_m = FloorAndWall();
  const Box panel = DrawPanel(depth_m, 0.3, 0.6, 2.0, 0.5, 0.9);
  const DepthView view = ViewOf(depth_m);
  const cv::Rect rect = ThumbnailOf(panel, view.step);
  const BoxBackground first = FindBoxBackground(view, rect, {}, {});
  const BoxBackground second = FindBoxBackground(view, rect, {}, {});
  ASSERT_EQ(first.mask.size(), second.mask.size());
  EXPECT_EQ(cv::countNonZero(first.mask != second.mask), 0);
}

}  // namespace
}  // namespace cslam
