// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/keypoint_labels.h"

#include "cslam/objects/test_depth.h"
#include "cslam/util/check.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

using test::DrawPanel;
using test::ViewOf;
using test::Wall;

Keypoint At(double u, double v, const cv::Mat& depth_m) {
  Keypoint keypoint;
  keypoint.raw_px = keypoint.uv_px = {static_cast<float>(u), static_cast<float>(v)};
  keypoint.depth_m = depth_m.at<float>(static_cast<int>(v), static_cast<int>(u));
  return keypoint;
}

// A person before a wall, with a box that is wider than the person.
struct PersonScene {
  cv::Mat depth_m = Wall(4.0);
  Box person = DrawPanel(depth_m, 0.0, 0.0, 2.0, 0.5, 1.2);
  DepthView view = ViewOf(depth_m);
  LabelledThing thing;
  std::vector<Keypoint> keypoints;  // on the person, on the wall in the box, outside

  PersonScene() {
    thing.box = {person.x_min - 60, person.y_min, person.x_max + 60, person.y_max};
    thing.class_id = 0;
    thing.track = TrackId(3);
    thing.region = SegmentBox(view, thing.box, true, {}, {});
    keypoints = {At(320, 240, depth_m), At(person.x_min - 40, 240, depth_m), At(20, 240, depth_m)};
  }

  std::vector<KeypointSemantics> Label(const std::string& rule) const {
    LabelOptions options;
    options.rule = rule;
    return LabelKeypoints(keypoints, {&thing, 1}, view, options);
  }
};

TEST(LabelKeypoints, TakesTheWholeBoxByTheBoxRule) {
  const PersonScene scene;
  const auto labels = scene.Label("boxes");
  EXPECT_EQ(labels[0].label, KeypointLabel::kDynamic);
  EXPECT_EQ(labels[1].label, KeypointLabel::kDynamic);
  EXPECT_EQ(labels[2].label, KeypointLabel::kStatic);
}

TEST(LabelKeypoints, KeepsTheBackgroundInTheBoxByTheOtherRules) {
  const PersonScene scene;
  for (const char* rule : {"bands", "surfaces"}) {
    const auto labels = scene.Label(rule);
    EXPECT_EQ(labels[0].label, KeypointLabel::kDynamic) << rule;
    EXPECT_EQ(labels[0].class_id, 0) << rule;
    EXPECT_EQ(labels[0].track, TrackId(3)) << rule;
    EXPECT_EQ(labels[1].label, KeypointLabel::kStatic) << rule;
    EXPECT_EQ(labels[1].class_id, -1) << rule;
    EXPECT_EQ(labels[2].label, KeypointLabel::kStatic) << rule;
  }
}

TEST(LabelKeypoints, TakesKeypointsWithoutDepthBesideThePersonForThePersons) {
  PersonScene scene;
  scene.keypoints = {At(scene.person.x_min - 3, 240, scene.depth_m),
                     At(scene.person.x_min - 40, 240, scene.depth_m)};
  for (Keypoint& keypoint : scene.keypoints)
    keypoint.depth_m = 0.0F;
  const auto labels = scene.Label("surfaces");
  EXPECT_EQ(labels[0].label, KeypointLabel::kDynamic);
  EXPECT_EQ(labels[1].label, KeypointLabel::kStatic);
}

TEST(LabelKeypoints, FallsBackToTheBoxWhenTheSurfaceIsNotKnown) {
  PersonScene scene;
  scene.thing.region = DepthRegion{};
  EXPECT_EQ(scene.Label("surfaces")[1].label, KeypointLabel::kDynamic);
}

TEST(LabelKeypoints, GivesAnOverlapToTheDynamicThing) {
  PersonScene scene;
  LabelledThing chair = scene.thing;
  chair.class_id = 56;
  chair.label = KeypointLabel::kMovable;
  const std::vector<LabelledThing> things{chair, scene.thing};
  const auto labels = LabelKeypoints(scene.keypoints, things, scene.view, {});
  EXPECT_EQ(labels[0].class_id, 0);
}

TEST(LabelKeypoints, DropsOrKeepsAnOccludedBoxAsAsked) {
  PersonScene scene;
  // A near pole at the side, the person's middle far behind it.
  DrawPanel(scene.depth_m, -0.2, 0.0, 0.7, 0.12, 0.5);
  scene.view = ViewOf(scene.depth_m);
  LabelOptions options;
  options.rule = "bands";
  options.max_depth_sigma_m = 0.3;
  auto labels = LabelKeypoints(scene.keypoints, {&scene.thing, 1}, scene.view, options);
  EXPECT_EQ(labels[1].label, KeypointLabel::kDynamic);
  options.drop_occluded = false;
  labels = LabelKeypoints(scene.keypoints, {&scene.thing, 1}, scene.view, options);
  EXPECT_EQ(labels[1].label, KeypointLabel::kStatic);
}

TEST(LabelKeypoints, NamesTheRulesThatThereAre) {
  LabelOptions options;
  options.rule = "magic";
  EXPECT_THROW(RuleOf(options), Error);
}

TEST(MeasureBoxDepths, LeavesOutWhatOtherBoxesCover) {
  cv::Mat depth = Wall(4.0);
  const Box front = DrawPanel(depth, -0.1, 0.0, 1.0, 0.2, 0.4);
  const Box box{200, 100, 440, 380};
  const DepthView view = ViewOf(depth);
  EXPECT_NEAR(MeasureBoxDepths(view, box, {}, 0.02).nearest_m, 1.0, 0.01);
  const BoxDepths without = MeasureBoxDepths(view, box, {&front, 1}, 0.02);
  EXPECT_NEAR(without.nearest_m, 4.0, 0.01);
  EXPECT_NEAR(without.sigma_m, 0.0, 0.01);
}

}  // namespace
}  // namespace cslam
