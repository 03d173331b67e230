// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/scene_eval/object_eval.h"

#include "cslam/scene_eval/test_scene.h"
#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace cslam {
namespace {

using test::Found;
using test::kChair;
using test::kLeft;
using test::kMiddle;
using test::kRight;
using test::kTv;
using test::kUmbrella;

test::TestWorld TwoThings() {
  test::TestWorld world;
  world.duration_s = 2.0;
  world.stays = {{.instance = 1, .class_id = kChair, .center = kLeft},
                 {.instance = 2, .class_id = kTv, .center = kRight}};
  return world;
}

ObjectEvaluation Evaluate(const test::TestWorld& world, std::vector<FoundObject> found,
                          const SceneEvalOptions& options = {}) {
  test::TestScene scene(world);
  scene.run.objects = std::move(found);
  return EvaluateObjects(scene.truth, scene.run, options);
}

TEST(EvaluateObjects, GivesFullMarksToAPerfectMap) {
  const ObjectEvaluation evaluation =
      Evaluate(TwoThings(), {Found(7, kChair, kLeft), Found(8, kTv, kRight)});
  EXPECT_EQ(evaluation.all.num_true, 2);
  EXPECT_EQ(evaluation.all.F1(), 1.0);
  EXPECT_EQ(evaluation.all.num_duplicates, 0);
  EXPECT_NEAR(evaluation.all.centroid_error_m, 0.0, 1e-9);
  EXPECT_NEAR(evaluation.all.box_iou, 1.0, 0.02);
  EXPECT_NEAR(evaluation.all.axis_extent_iou, 1.0, 0.02);
  EXPECT_EQ(evaluation.classes.at(kTv).F1(), 1.0);
}

TEST(EvaluateObjects, CountsMissingThingsAgainstRecall) {
  const ObjectEvaluation evaluation = Evaluate(TwoThings(), {Found(7, kChair, kLeft)});
  EXPECT_EQ(evaluation.all.Recall(), 0.5);
  EXPECT_EQ(evaluation.all.Precision(), 1.0);
  EXPECT_EQ(evaluation.classes.at(kTv).Recall(), 0.0);
  EXPECT_FALSE(evaluation.classes.at(kTv).Precision());
}

TEST(EvaluateObjects, CountsASecondObjectForOneThingAsDuplicateAndFalse) {
  const Eigen::Vector3d beside = kLeft + Eigen::Vector3d(0.3, 0.0, 0.0);
  const ObjectEvaluation evaluation = Evaluate(
      TwoThings(), {Found(6, kChair, beside), Found(7, kChair, kLeft), Found(8, kTv, kRight)});
  EXPECT_EQ(evaluation.all.num_duplicates, 1);
  EXPECT_EQ(evaluation.all.num_matched, 2);
  EXPECT_EQ(evaluation.all.num_reported, 3);
  EXPECT_EQ(evaluation.objects[0].verdict, ObjectVerdict::kDuplicate);
  EXPECT_EQ(evaluation.objects[1].verdict, ObjectVerdict::kMatched) << "the nearer one";
}

TEST(EvaluateObjects, SaysWhatAThingOfTheWrongClassIs) {
  const ObjectEvaluation evaluation =
      Evaluate(TwoThings(), {Found(7, kTv, kLeft), Found(8, kTv, kRight)});
  EXPECT_EQ(evaluation.all.num_matched, 1);
  EXPECT_EQ(evaluation.objects[0].verdict, ObjectVerdict::kFalse);
  EXPECT_EQ(evaluation.objects[0].confused_with, kChair);
}

TEST(EvaluateObjects, MatchesOnlyWithinTheDistance) {
  const Eigen::Vector3d off = kLeft + Eigen::Vector3d(0.0, 0.0, 0.3);
  EXPECT_EQ(Evaluate(TwoThings(), {Found(7, kChair, off)}).all.num_matched, 1);
  EXPECT_EQ(Evaluate(TwoThings(), {Found(7, kChair, off)}, {.max_distance_m = 0.2}).all.num_matched,
            0);
}

TEST(EvaluateObjects, LooksOnlyAtPresentObjectsOfClassesAskedFor) {
  std::vector<FoundObject> found{Found(7, kChair, kLeft), Found(8, kUmbrella, kMiddle),
                                 Found(9, kTv, kMiddle)};
  found[2].report.state = "absent";
  const ObjectEvaluation evaluation = Evaluate(TwoThings(), found, {.classes = {kChair}});
  EXPECT_EQ(evaluation.all.F1(), 1.0);
  EXPECT_EQ(evaluation.num_other_classes, 1);
}

TEST(EvaluateObjects, AsksForNothingThatWasNeverInView) {
  test::TestWorld world = TwoThings();
  const Eigen::Vector3d behind(0.0, 0.0, -3.0);
  world.stays.push_back({.instance = 3, .class_id = kChair, .center = behind});
  const ObjectEvaluation evaluation =
      Evaluate(world, {Found(7, kChair, kLeft), Found(8, kTv, kRight), Found(9, kChair, behind)});
  EXPECT_EQ(evaluation.all.num_true, 2);
  EXPECT_EQ(evaluation.all.num_reported, 2) << "nor does it call wrong what is there unseen";
  EXPECT_EQ(evaluation.objects[2].verdict, ObjectVerdict::kNotJudged);
}

TEST(EvaluateObjects, AsksForNothingThatIsHidden) {
  test::TestWorld world = TwoThings();
  world.stays.push_back({.instance = 3, .class_id = kChair, .center = 1.35 * kLeft});
  EXPECT_EQ(Evaluate(world, {}).all.num_true, 2);
}

TEST(EvaluateObjects, CallsAnObjectFalseThatLeftInView) {
  test::TestWorld world = TwoThings();
  world.stays[0].to_s = 1.0;
  const ObjectEvaluation evaluation =
      Evaluate(world, {Found(7, kChair, kLeft), Found(8, kTv, kRight)});
  EXPECT_EQ(evaluation.all.num_true, 1);
  EXPECT_EQ(evaluation.objects[0].verdict, ObjectVerdict::kFalse);
}

TEST(EvaluateObjects, DoesNotJudgeWhatLeftWhileNobodyLooked) {
  test::TestWorld world = TwoThings();
  world.stays[0].to_s = 1.0;
  world.yaw_rad = [](double time_s) { return time_s < 0.9 ? 0.0 : std::numbers::pi; };
  const ObjectEvaluation evaluation =
      Evaluate(world, {Found(7, kChair, kLeft), Found(8, kTv, kRight)});
  EXPECT_EQ(evaluation.objects[0].verdict, ObjectVerdict::kNotJudged);
  EXPECT_EQ(evaluation.all.F1(), 1.0);
}

TEST(EvaluateObjects, CallsAnObjectFalseWhoseReplacementHidesItsPlace) {
  test::TestWorld world = TwoThings();
  const Eigen::Vector3d before_it = 0.8 * kLeft;
  world.stays[0].to_s = 1.0;
  world.stays.push_back({.instance = 3, .class_id = kUmbrella, .from_s = 1.0, .center = before_it});
  const std::vector<FoundObject> found{Found(7, kChair, kLeft)};
  EXPECT_EQ(Evaluate(world, found).objects[0].verdict, ObjectVerdict::kNotJudged) << "hidden";
  TrueChange replaced{.kind = ChangeKind::kReplaced, .time_s = 1.0, .instance = 1};
  replaced.class_id = kChair;
  replaced.new_instance = 3;
  replaced.new_class_id = kUmbrella;
  replaced.from = test::At(kLeft);
  replaced.to = test::At(before_it);
  world.changes = {replaced};
  EXPECT_EQ(Evaluate(world, found).objects[0].verdict, ObjectVerdict::kFalse);
}

TEST(EvaluateObjects, NeedsTheRunsObjects) {
  test::TestScene scene(TwoThings());
  scene.run.objects.reset();
  EXPECT_THAT(MessageOf([&] { EvaluateObjects(scene.truth, scene.run); }),
              testing::HasSubstr("objects.json"));
}

}  // namespace
}  // namespace cslam
