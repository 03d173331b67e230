// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/object_uses.h"

#include "cslam/objects/test_depth.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

using test::SceneCamera;

constexpr int kCouch = 57;

FollowedObject ThingOfClass(int class_id) {
  FollowedObject thing;
  thing.class_id = class_id;
  thing.box = {100, 100, 200, 200};
  thing.region.mask = cv::Mat::zeros(60, 80, CV_8UC1);
  thing.region.num_pixels = 100;
  thing.region.median_m = 2.0F;
  return thing;
}

FollowedObject Flat(FollowedObject thing, double side_px) {
  thing.is_flat = true;
  thing.box = {100, 100, 100 + side_px, 200};
  return thing;
}

TEST(ObjectUsesTest, TrustsNeitherPeopleNorWhatMovesWithoutAName) {
  const ObjectUses uses(SceneCamera(), ObjectTrackerOptions{});
  EXPECT_EQ(uses.LabelOf(ThingOfClass(kPersonClass)), KeypointLabel::kDynamic);
  EXPECT_EQ(uses.LabelOf(ThingOfClass(-1)), KeypointLabel::kDynamic);
}

TEST(ObjectUsesTest, TakesOnlyWhatLiesFlatOverAMetreForFloor) {
  const ObjectUses uses(SceneCamera(), ObjectTrackerOptions{});
  EXPECT_TRUE(uses.IsRoom(Flat(ThingOfClass(kCouch), 300.0)));  // 1.14 m at 2 m
  EXPECT_FALSE(uses.IsRoom(Flat(ThingOfClass(kCouch), 200.0)));
  EXPECT_FALSE(uses.IsRoom(Flat(ThingOfClass(kPersonClass), 300.0))) << "somebody lies there";
}

TEST(ObjectUsesTest, HoldsBackWhatNobodyHasSeenStandUnlessItFillsThePicture) {
  ObjectTrackerOptions options;
  options.hold_back_new = true;
  FollowedObject couch = ThingOfClass(kCouch);
  EXPECT_EQ(ObjectUses(SceneCamera(), options).LabelOf(couch), KeypointLabel::kDynamic);
  couch.region.num_pixels = 60 * 80;
  EXPECT_EQ(ObjectUses(SceneCamera(), options).LabelOf(couch), KeypointLabel::kMovable);
  options.hold_back_new = false;
  couch.region.num_pixels = 100;
  EXPECT_EQ(ObjectUses(SceneCamera(), options).LabelOf(couch), KeypointLabel::kMovable);
}

}  // namespace
}  // namespace cslam
