// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/region_outline.h"

#include "cslam/objects/test_depth.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace cslam {
namespace {

using test::DrawPanel;
using test::ViewOf;
using test::Wall;

DepthRegion RegionOf(const DepthView& view, const Box& box) {
  return SegmentBox(view, box, false, {}, {});
}

TEST(IsClipped, TellsWhatReachesOutOfThePicture) {
  cv::Mat depth_m = Wall(4.0);
  const Box inside = DrawPanel(depth_m, 0.0, 0.0, 2.0, 0.6, 0.6);
  const Box beyond = DrawPanel(depth_m, -1.2, 0.0, 2.0, 0.6, 0.6);
  const DepthView view = ViewOf(depth_m);
  EXPECT_FALSE(IsClipped(RegionOf(view, inside)));
  EXPECT_TRUE(IsClipped(RegionOf(view, beyond)));
}

TEST(IsCovered, TellsWhatHasSomethingNearerBesideIt) {
  cv::Mat depth_m = Wall(4.0);
  const Box chair = DrawPanel(depth_m, 0.0, 0.0, 2.0, 0.6, 0.6);
  const DepthRegion alone = RegionOf(ViewOf(depth_m), chair);
  ASSERT_FALSE(alone.empty());
  EXPECT_FALSE(IsCovered(alone, ViewOf(depth_m)));
  DrawPanel(depth_m, -0.3, 0.0, 1.2, 0.3, 1.0);
  const DepthView view = ViewOf(depth_m);
  const DepthRegion rest = RegionOf(view, chair);
  ASSERT_FALSE(rest.empty());
  EXPECT_TRUE(IsCovered(rest, view));
}

TEST(ShareInside, IsTheShareOfTheFirstThatTheSecondCovers) {
  cv::Mat depth_m = Wall(4.0);
  const Box whole = DrawPanel(depth_m, 0.0, 0.0, 2.0, 0.8, 0.8);
  const DepthView view = ViewOf(depth_m);
  const DepthRegion thing = RegionOf(view, whole);
  DepthRegion half = thing;
  half.mask = half.mask.clone();
  half.mask.rowRange(0, half.mask.rows / 2).setTo(0);
  half.num_pixels = cv::countNonZero(half.mask);
  ASSERT_GT(half.num_pixels, 0);
  EXPECT_DOUBLE_EQ(ShareInside(half, thing), 1.0);
  EXPECT_NEAR(ShareInside(thing, half), 0.5, 0.1);
  EXPECT_DOUBLE_EQ(ShareInside(thing, DepthRegion{}), 0.0);
}

}  // namespace
}  // namespace cslam
