// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/scene_eval/change_eval.h"

#include "cslam/scene_eval/test_scene.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace cslam {
namespace {

using test::kChair;
using test::kLeft;
using test::kRight;
using test::kTv;
using test::kUmbrella;

constexpr double kChangeS = 4.0;

TrueChange True(ChangeKind kind, int instance, const std::optional<Eigen::Vector3d>& from,
                const std::optional<Eigen::Vector3d>& to, double time_s = kChangeS) {
  TrueChange change{.kind = kind, .time_s = time_s, .instance = instance, .class_id = kChair};
  if (from) change.from = test::At(*from);
  if (to) change.to = test::At(*to);
  return change;
}

ReportedChange Told(ChangeKind kind, const std::optional<Eigen::Vector3d>& from,
                    const std::optional<Eigen::Vector3d>& to, double time_s) {
  ReportedChange change{.kind = kind, .object = 3, .class_id = kChair};
  change.from = from;
  change.to = to;
  change.reported = test::StampAt(time_s);
  return change;
}

// Looks away from 3 s to 5 s.
double LookAway(double time_s) {
  return time_s < 3.0 || time_s >= 5.0 ? 0.0 : std::numbers::pi;
}

test::TestWorld MovedChair() {
  test::TestWorld world;
  world.stays = {{.instance = 1, .to_s = kChangeS, .center = kLeft},
                 {.instance = 1, .from_s = kChangeS, .center = kRight}};
  world.changes = {True(ChangeKind::kMoved, 1, kLeft, kRight)};
  world.yaw_rad = LookAway;
  return world;
}

ChangeEvaluation Evaluate(const test::TestWorld& world, std::vector<ReportedChange> told,
                          const SceneEvalOptions& options = {}) {
  test::TestScene scene(world);
  scene.run.changes = std::move(told);
  return EvaluateChanges(scene.truth, scene.run, options);
}

TEST(EvaluateChanges, GivesFullMarksToAPerfectReport) {
  const ChangeEvaluation evaluation =
      Evaluate(MovedChair(), {Told(ChangeKind::kMoved, kLeft, kRight, 6.0)});
  EXPECT_EQ(evaluation.all.num_true, 1);
  EXPECT_EQ(evaluation.all.F1(), 1.0);
  EXPECT_EQ(evaluation.kinds.at(ChangeKind::kMoved).F1(), 1.0);
  ASSERT_TRUE(evaluation.median_delay_s);
  EXPECT_NEAR(*evaluation.median_delay_s, 1.0, 0.05) << "the camera looks again at 5 s";
  EXPECT_NEAR(*evaluation.changes[0].delay_from_old_place_s, 1.0, 0.05);
}

TEST(EvaluateChanges, MissesWhatIsNotTold) {
  const ChangeEvaluation evaluation = Evaluate(MovedChair(), {});
  EXPECT_EQ(evaluation.all.Recall(), 0.0);
  EXPECT_FALSE(evaluation.all.Precision());
  EXPECT_FALSE(evaluation.median_delay_s);
}

TEST(EvaluateChanges, CountsAMoveToldAsRemovalAndAdditionAsAPartialMiss) {
  const ChangeEvaluation evaluation = Evaluate(
      MovedChair(),
      {Told(ChangeKind::kRemoved, kLeft, {}, 5.5), Told(ChangeKind::kAdded, {}, kRight, 5.5)});
  EXPECT_EQ(evaluation.all.num_matched, 0);
  EXPECT_EQ(evaluation.all.num_reported, 2);
  EXPECT_EQ(evaluation.num_partial, 1);
  EXPECT_TRUE(evaluation.changes[0].is_partial);
  EXPECT_EQ(evaluation.reports[0].verdict, ChangeVerdict::kPart);
}

TEST(EvaluateChanges, RefusesWhatWasToldBeforeItCouldBeSeen) {
  const ChangeEvaluation evaluation =
      Evaluate(MovedChair(), {Told(ChangeKind::kMoved, kLeft, kRight, 4.5)});
  EXPECT_EQ(evaluation.all.num_matched, 0);
  EXPECT_EQ(evaluation.num_early, 1);
  EXPECT_EQ(evaluation.reports[0].verdict, ChangeVerdict::kEarly);
}

TEST(EvaluateChanges, NeedsKindClassAndBothPlaces) {
  const ReportedChange good = Told(ChangeKind::kMoved, kLeft, kRight, 6.0);
  ReportedChange other_class = good;
  other_class.class_id = kTv;
  ReportedChange elsewhere = good;
  elsewhere.to = kRight + Eigen::Vector3d(0.6, 0.0, 0.0);
  for (const ReportedChange& report : {other_class, elsewhere}) {
    const ChangeEvaluation evaluation =
        Evaluate(MovedChair(), {report}, {.classes = {kChair, kTv}});
    EXPECT_EQ(evaluation.all.num_matched, 0);
    EXPECT_EQ(evaluation.reports[0].verdict, ChangeVerdict::kFalse);
  }
}

TEST(EvaluateChanges, MatchesOneToOne) {
  const ReportedChange good = Told(ChangeKind::kMoved, kLeft, kRight, 6.0);
  const ChangeEvaluation evaluation = Evaluate(MovedChair(), {good, good});
  EXPECT_EQ(evaluation.all.num_matched, 1);
  EXPECT_EQ(evaluation.all.Precision(), 0.5);
}

TEST(EvaluateChanges, LeavesOutWhatIsNeverSeenAgain) {
  test::TestWorld world = MovedChair();
  world.yaw_rad = [](double time_s) { return time_s < 3.0 ? 0.0 : std::numbers::pi; };
  const ChangeEvaluation evaluation = Evaluate(world, {Told(ChangeKind::kRemoved, kLeft, {}, 6.0)});
  EXPECT_EQ(evaluation.all.num_true, 0);
  EXPECT_EQ(evaluation.all.num_reported, 0);
  EXPECT_THAT(evaluation.changes[0].truth.why_not, testing::HasSubstr("old place"));
  EXPECT_EQ(evaluation.reports[0].verdict, ChangeVerdict::kNotJudged);
}

TEST(EvaluateChanges, LeavesOutWhatWasNeverSeenBefore) {
  test::TestWorld world = MovedChair();
  world.yaw_rad = [](double time_s) { return time_s < 5.0 ? std::numbers::pi : 0.0; };
  EXPECT_EQ(Evaluate(world, {}).all.num_true, 0);
}

TEST(EvaluateChanges, JoinsMovesBetweenWhichNobodyLooked) {
  test::TestWorld world = MovedChair();
  const Eigen::Vector3d middle(0.0, 0.0, 3.5);
  world.stays = {{.instance = 1, .to_s = 3.5, .center = kLeft},
                 {.instance = 1, .from_s = 3.5, .to_s = kChangeS, .center = middle},
                 {.instance = 1, .from_s = kChangeS, .center = kRight}};
  world.changes = {True(ChangeKind::kMoved, 1, kLeft, middle, 3.5),
                   True(ChangeKind::kMoved, 1, middle, kRight)};
  const ChangeEvaluation evaluation =
      Evaluate(world, {Told(ChangeKind::kMoved, kLeft, kRight, 6.0)});
  ASSERT_EQ(evaluation.changes.size(), 1U);
  EXPECT_EQ(evaluation.changes[0].truth.num_merged, 2);
  EXPECT_EQ(evaluation.all.F1(), 1.0);

  const auto first = Told(ChangeKind::kMoved, kLeft, middle, 3.6);
  const auto second = Told(ChangeKind::kMoved, middle, kRight, 6.0);
  EXPECT_EQ(Evaluate(world, {first, second}).all.F1(), 1.0) << "a glimpse was enough";
  EXPECT_EQ(Evaluate(world, {first}).all.num_matched, 0) << "half of it is not the whole";
}

TEST(EvaluateChanges, KeepsMovesApartBetweenWhichTheCameraLooked) {
  test::TestWorld world = MovedChair();
  const Eigen::Vector3d middle(0.0, 0.0, 3.5);
  world.stays = {{.instance = 1, .to_s = 2.0, .center = kLeft},
                 {.instance = 1, .from_s = 2.0, .to_s = kChangeS, .center = middle},
                 {.instance = 1, .from_s = kChangeS, .center = kRight}};
  world.changes = {True(ChangeKind::kMoved, 1, kLeft, middle, 2.0),
                   True(ChangeKind::kMoved, 1, middle, kRight)};
  EXPECT_EQ(Evaluate(world, {}).all.num_true, 2);
}

TEST(EvaluateChanges, ForgetsWhatIsBackBeforeAnybodyLooked) {
  test::TestWorld world = MovedChair();
  world.stays = {{.instance = 1, .to_s = 3.5, .center = kLeft},
                 {.instance = 1, .from_s = 3.5, .to_s = kChangeS, .center = kRight},
                 {.instance = 1, .from_s = kChangeS, .center = kLeft}};
  world.changes = {True(ChangeKind::kMoved, 1, kLeft, kRight, 3.5),
                   True(ChangeKind::kMoved, 1, kRight, kLeft)};
  const ChangeEvaluation silent = Evaluate(world, {});
  ASSERT_EQ(silent.changes.size(), 1U);
  EXPECT_FALSE(silent.changes[0].truth.counts());
  const ChangeEvaluation told = Evaluate(world, {Told(ChangeKind::kMoved, kLeft, kRight, 3.6)});
  EXPECT_EQ(told.reports[0].verdict, ChangeVerdict::kNotJudged) << "true, if nobody had to know";
}

TEST(EvaluateChanges, KnowsRemovalsAdditionsAndReplacements) {
  const Eigen::Vector3d middle(0.0, 0.0, 3.0);
  test::TestWorld world = MovedChair();
  world.stays = {{.instance = 1, .to_s = kChangeS, .center = kLeft},
                 {.instance = 2, .from_s = kChangeS, .center = kRight},
                 {.instance = 3, .to_s = kChangeS, .center = middle},
                 {.instance = 4, .class_id = kUmbrella, .from_s = kChangeS, .center = middle}};
  TrueChange replaced = True(ChangeKind::kReplaced, 3, middle, middle);
  replaced.new_instance = 4;
  replaced.new_class_id = kUmbrella;
  world.changes = {True(ChangeKind::kRemoved, 1, kLeft, {}),
                   True(ChangeKind::kAdded, 2, {}, kRight), replaced};
  ReportedChange told = Told(ChangeKind::kReplaced, middle, middle, 6.0);
  told.new_class_id = kUmbrella;
  const ChangeEvaluation evaluation =
      Evaluate(world, {Told(ChangeKind::kRemoved, kLeft, {}, 6.0),
                       Told(ChangeKind::kAdded, {}, kRight, 6.0), told});
  EXPECT_EQ(evaluation.all.num_true, 3);
  EXPECT_EQ(evaluation.all.F1(), 1.0);
  for (const ChangeKind kind : {ChangeKind::kRemoved, ChangeKind::kAdded, ChangeKind::kReplaced})
    EXPECT_EQ(evaluation.kinds.at(kind).num_matched, 1) << NameOf(kind);
}

TEST(EvaluateChanges, CountsWhatIsCarriedInView) {
  test::TestWorld world = MovedChair();
  world.yaw_rad = test::LookStraight;
  world.stays[0].to_s = 2.0;  // carried from 2 s to 4 s
  world.changes[0].is_carried_in_view = true;
  const ChangeEvaluation evaluation =
      Evaluate(world, {Told(ChangeKind::kMoved, kLeft, kRight, 4.5)});
  EXPECT_EQ(evaluation.all.F1(), 1.0);
  EXPECT_NEAR(*evaluation.changes[0].truth.old_view_s, 2.0, 0.05);
  EXPECT_NEAR(*evaluation.changes[0].delay_s, 0.5, 0.05) << "from when it stands again";
  EXPECT_NEAR(*evaluation.changes[0].delay_from_old_place_s, 2.5, 0.05);
}

TEST(EvaluateChanges, CountsWhatChangedBetweenTwoSessions) {
  test::TestWorld world = MovedChair();
  world.yaw_rad = test::LookStraight;
  test::TestScene scene(world);
  scene.run.trajectory.erase(scene.run.trajectory.begin(), scene.run.trajectory.begin() + 60);
  scene.run.changes = {Told(ChangeKind::kMoved, kLeft, kRight, 6.5)};
  EXPECT_EQ(EvaluateChanges(scene.truth, scene.run).all.num_true, 0) << "it began with nothing";
  scene.run.earlier = SessionTime{.from = test::StampAt(0.0), .to = test::StampAt(2.0)};
  const ChangeEvaluation evaluation = EvaluateChanges(scene.truth, scene.run);
  EXPECT_EQ(evaluation.all.F1(), 1.0);
  EXPECT_NEAR(*evaluation.changes.at(0).truth.old_view_s, 6.0, 0.05) << "nobody looked at 4 s";
}

TEST(EvaluateChanges, LeavesOutWhatTheRunDidNotLiveToSee) {
  test::TestScene scene(MovedChair());
  scene.run.trajectory.resize(30);
  EXPECT_TRUE(EvaluateChanges(scene.truth, scene.run).changes.empty());
}

}  // namespace
}  // namespace cslam
