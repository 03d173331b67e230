// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/depth_region.h"

#include "cslam/objects/test_depth.h"

#include <gtest/gtest.h>

#include <limits>

namespace cslam {
namespace {

using test::Coverage;
using test::DrawPanel;
using test::ViewOf;
using test::Wall;

TEST(SegmentBox, TakesThePersonAndLeavesTheWallWhenTheBoxHoldsBoth) {
  cv::Mat depth = Wall(4.0);
  const Box person = DrawPanel(depth, 0.0, 0.0, 2.0, 0.5, 1.6);
  const Box wide{person.x_min - 30, person.y_min - 20, person.x_max + 30, person.y_max + 20};
  const DepthView view = ViewOf(depth);
  const DepthRegion region = SegmentBox(view, wide, true, {}, {});
  EXPECT_GT(Coverage(region, person, view.step), 0.95);
  EXPECT_LT(region.num_pixels * view.step * view.step, 1.05 * person.area());
  EXPECT_NEAR(region.median_m, 2.0F, 0.01F);
  EXPECT_NEAR(region.centre_camera.x(), 0.0, 0.02);
}

TEST(SegmentBox, LooksPastATableThatCoversThePersonsLegs) {
  cv::Mat depth = Wall(4.0);
  const Box person = DrawPanel(depth, 0.0, 0.0, 2.0, 0.5, 1.6);
  DrawPanel(depth, 0.0, 0.6, 1.2, 1.5, 0.5);
  const DepthRegion region = SegmentBox(ViewOf(depth), person, true, {}, {});
  EXPECT_NEAR(region.median_m, 2.0F, 0.01F);
}

TEST(SegmentBox, TakesTheBearAndNotTheArmOfTheChairBeforeIt) {
  cv::Mat depth = Wall(1.9);
  const Box bear = DrawPanel(depth, 0.0, 0.0, 1.5, 0.30, 0.40);
  DrawPanel(depth, 0.20, 0.0, 1.2, 0.44, 0.29);
  const DepthView view = ViewOf(depth);
  RegionOptions options;
  options.background.enabled = false;  // real arms are round, not planes
  EXPECT_NEAR(SegmentBox(view, bear, false, {}, options).median_m, 1.5F, 0.01F);
  options.occluder.enabled = false;
  EXPECT_NEAR(SegmentBox(view, bear, false, {}, options).median_m, 1.2F, 0.01F);
}

TEST(SegmentBox, LeavesOutWhatIsExcluded) {
  cv::Mat depth = Wall(4.0);
  const Box person = DrawPanel(depth, 0.0, 0.0, 2.0, 0.6, 1.6);
  const DepthView view = ViewOf(depth);
  cv::Mat excluded = cv::Mat::zeros(view.depth_mm.size(), CV_8UC1);
  excluded.colRange(0, excluded.cols / 2).setTo(255);
  const DepthRegion region = SegmentBox(view, person, true, excluded, {});
  EXPECT_NEAR(Coverage(region, person, view.step), 0.5, 0.05);
}

TEST(SegmentBox, IsEmptyWithoutDepthWithoutOverlapAndForBrokenBoxes) {
  const DepthView blank = ViewOf(Wall(0.0));
  EXPECT_TRUE(SegmentBox(blank, {100, 100, 200, 200}, true, {}, {}).empty());
  const DepthView view = ViewOf(Wall(2.0));
  EXPECT_TRUE(SegmentBox(view, {700, 100, 900, 200}, true, {}, {}).empty());
  EXPECT_TRUE(SegmentBox(view, {200, 200, 100, 100}, true, {}, {}).empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(SegmentBox(view, {nan, 0, 100, 100}, true, {}, {}).empty());
  EXPECT_TRUE(SegmentBox(DepthView{}, {0, 0, 10, 10}, true, {}, {}).empty());
}

TEST(SegmentMask, TakesWhatTheMaskCoversAndNoMore) {
  cv::Mat depth = Wall(4.0);
  const Box person = DrawPanel(depth, 0.0, 0.0, 2.0, 0.6, 1.2);
  const DepthView view = ViewOf(depth);
  cv::Mat upper_half = cv::Mat::zeros(28, 28, CV_8UC1);
  upper_half.rowRange(0, 14).setTo(255);
  const DepthRegion region = SegmentMask(view, person, upper_half, true, {}, {});
  EXPECT_NEAR(Coverage(region, person, view.step), 0.5, 0.05);
  EXPECT_TRUE(SegmentMask(view, person, cv::Mat::zeros(28, 28, CV_8UC1), true, {}, {}).empty());
}

TEST(CarryRegion, FollowsAPersonWhoWalksWhileTheCameraTurns) {
  cv::Mat before = Wall(4.0);
  const Box box = DrawPanel(before, 0.0, 0.0, 2.0, 0.5, 1.2);
  cv::Mat after = Wall(4.0);
  const Box now = DrawPanel(after, 0.3, 0.0, 2.0, 0.5, 1.2);
  const DepthView from = ViewOf(before);
  const DepthView to = ViewOf(after);
  const DepthRegion region = SegmentBox(from, box, true, {}, {});
  // 0.2 m by the camera's own motion, 0.1 m by walking.
  const Se3 T_to_from{Eigen::Quaterniond::Identity(), {0.2, 0.0, 0.0}};
  const DepthRegion carried =
      CarryRegion(from, region, to, T_to_from, {0.1, 0.0, 0.0}, 8.0, true, {});
  EXPECT_GT(Coverage(carried, now, to.step), 0.95);
  EXPECT_GT(carried.support, 0.9);
}

TEST(CarryRegion, GrowsOverWhatTheStepUncoversWhenTheVelocityIsUnknown) {
  cv::Mat before = Wall(4.0);
  const Box box = DrawPanel(before, 0.0, 0.0, 2.0, 0.5, 1.2);
  cv::Mat after = Wall(4.0);
  const Box now = DrawPanel(after, 0.06, 0.0, 2.0, 0.5, 1.2);
  const DepthView from = ViewOf(before);
  const DepthView to = ViewOf(after);
  const DepthRegion carried = CarryRegion(from, SegmentBox(from, box, true, {}, {}), to, Se3(),
                                          Eigen::Vector3d::Zero(), 24.0, true, {});
  EXPECT_GT(Coverage(carried, now, to.step), 0.95);
}

TEST(CarryRegion, IsEmptyWhenTheThingIsGone) {
  cv::Mat before = Wall(4.0);
  const Box box = DrawPanel(before, 0.0, 0.0, 2.0, 0.5, 1.2);
  const DepthView from = ViewOf(before);
  const DepthRegion region = SegmentBox(from, box, true, {}, {});
  EXPECT_TRUE(
      CarryRegion(from, region, ViewOf(Wall(4.0)), Se3(), Eigen::Vector3d::Zero(), 24.0, true, {})
          .empty());
  EXPECT_TRUE(
      CarryRegion(from, region, ViewOf(Wall(0.0)), Se3(), Eigen::Vector3d::Zero(), 24.0, true, {})
          .empty());
}

}  // namespace
}  // namespace cslam
