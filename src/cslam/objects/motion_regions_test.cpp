// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/motion_regions.h"

#include "cslam/objects/test_depth.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

using test::Coverage;
using test::DrawPanel;
using test::ViewOf;
using test::Wall;

TEST(FindMovedRegions, FindsABoxThatHasMovedBeforeAWall) {
  cv::Mat before = Wall(4.0);
  DrawPanel(before, -0.4, 0.0, 2.0, 0.5, 0.5);
  cv::Mat after = Wall(4.0);
  const Box now_box = DrawPanel(after, 0.1, 0.0, 2.0, 0.5, 0.5);
  const DepthView earlier = ViewOf(before);
  const DepthView now = ViewOf(after);
  const EarlierView view{&earlier, Se3(), 0.2};
  const auto regions = FindMovedRegions(now, {&view, 1}, {}, {});
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_GT(Coverage(regions[0], now_box, now.step), 0.9);
  EXPECT_LT(regions[0].num_pixels * now.step * now.step, 1.2 * now_box.area());
}

TEST(FindMovedRegions, FindsNothingWhenOnlyTheCameraMoves) {
  cv::Mat before = Wall(4.0);
  DrawPanel(before, 0.0, 0.0, 2.0, 0.5, 0.5);
  cv::Mat after = Wall(4.0);
  DrawPanel(after, -0.2, 0.0, 2.0, 0.5, 0.5);
  const DepthView earlier = ViewOf(before);
  const DepthView now = ViewOf(after);
  const EarlierView view{&earlier, Se3{Eigen::Quaterniond::Identity(), {0.2, 0.0, 0.0}}, 0.2};
  EXPECT_TRUE(FindMovedRegions(now, {&view, 1}, {}, {}).empty());
}

TEST(FindMovedRegions, DoesNotJudgeWhatTheEarlierViewCouldNotSee) {
  // A thing that comes out from behind the left border of the earlier view.
  cv::Mat after = Wall(4.0);
  DrawPanel(after, -1.0, 0.0, 2.0, 0.4, 0.8);
  const DepthView earlier = ViewOf(Wall(4.0));
  const DepthView now = ViewOf(after);
  const EarlierView view{&earlier, Se3{Eigen::Quaterniond::Identity(), {-0.8, 0.0, 0.0}}, 0.2};
  EXPECT_TRUE(FindMovedRegions(now, {&view, 1}, {}, {}).empty());
  // Nor where it had no reading.
  const DepthView blank = ViewOf(Wall(0.0));
  const EarlierView blind{&blank, Se3(), 0.2};
  EXPECT_TRUE(FindMovedRegions(now, {&blind, 1}, {}, {}).empty());
}

TEST(FindMovedRegions, TakesAMostlyChangedPictureForAWrongPose) {
  const DepthView earlier = ViewOf(Wall(4.0));
  const DepthView now = ViewOf(Wall(2.0));
  const EarlierView view{&earlier, Se3(), 0.2};
  EXPECT_TRUE(FindMovedRegions(now, {&view, 1}, {}, {}).empty());
}

TEST(FindMovedRegions, LeavesOutWhatIsKnownAlready) {
  cv::Mat after = Wall(4.0);
  DrawPanel(after, 0.1, 0.0, 2.0, 0.5, 0.5);
  const DepthView earlier = ViewOf(Wall(4.0));
  const DepthView now = ViewOf(after);
  const EarlierView view{&earlier, Se3(), 0.2};
  const cv::Mat known(now.depth_mm.size(), CV_8UC1, cv::Scalar(255));
  EXPECT_TRUE(FindMovedRegions(now, {&view, 1}, known, {}).empty());
}

}  // namespace
}  // namespace cslam
