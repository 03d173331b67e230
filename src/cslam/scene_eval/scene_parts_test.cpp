// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/point_cloud_file.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/scene_eval/assignment.h"
#include "cslam/scene_eval/box_overlap.h"
#include "cslam/scene_eval/loop_eval.h"
#include "cslam/scene_eval/ply_points.h"
#include "cslam/scene_eval/scene_run.h"
#include "cslam/scene_eval/test_scene.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace cslam {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(AssignPairs, PrefersManyPairsToCheapOnes) {
  // Greedily the first row would take the first column, and leave the second without.
  const PairCosts costs{{0.1, 0.4}, {0.2, std::nullopt}};
  EXPECT_THAT(AssignPairs(costs), ElementsAre(1, 0));
}

TEST(AssignPairs, TakesTheCheapestOfEquallyMany) {
  const PairCosts costs{{0.3, 0.1, 0.5}, {0.1, 0.2, 0.4}};
  EXPECT_THAT(AssignPairs(costs), ElementsAre(1, 0));
}

TEST(AssignPairs, LeavesAloneWhatBelongsToNothing) {
  const PairCosts costs{{std::nullopt}, {0.5}, {0.4}};
  EXPECT_THAT(AssignPairs(costs), ElementsAre(std::nullopt, std::nullopt, 0));
  EXPECT_TRUE(AssignPairs({}).empty());
  EXPECT_THAT(AssignPairs({{}, {}}), ElementsAre(std::nullopt, std::nullopt));
}

TEST(IntersectionOverUnion, IsThatOfShiftedAndTurnedBoxes) {
  const PlacedBox box{test::At({1.0, 2.0, 3.0}), {1.0, 1.0, 1.0}};
  const PlacedBox half{test::At({1.5, 2.0, 3.0}), {1.0, 1.0, 1.0}};
  const PlacedBox inner{test::At({1.0, 2.0, 3.0}), {0.5, 1.0, 1.0}};
  const PlacedBox far{test::At({4.0, 2.0, 3.0}), {1.0, 1.0, 1.0}};
  PlacedBox turned = box;
  turned.T_world_box.rotation =
      Eigen::AngleAxisd(0.25 * std::numbers::pi, Eigen::Vector3d::UnitZ());
  const double octagon = 2.0 * (std::numbers::sqrt2 - 1.0);  // area of two turned unit squares
  EXPECT_NEAR(IntersectionOverUnion(box, box), 1.0, 0.01);
  EXPECT_NEAR(IntersectionOverUnion(box, half), 1.0 / 3.0, 0.01);
  EXPECT_NEAR(IntersectionOverUnion(box, inner), 0.5, 0.01);
  EXPECT_NEAR(IntersectionOverUnion(box, turned), octagon / (2.0 - octagon), 0.01);
  EXPECT_EQ(IntersectionOverUnion(box, far), 0.0);
  EXPECT_EQ(IntersectionOverUnion(box, {test::At({1.0, 2.0, 3.0}), {0.0, 1.0, 1.0}}), 0.0);
}

TEST(ReadPlyPoints, TakesBackWhatARunWrites) {
  const TestFolder folder;
  const std::vector<ColoredPoint> points{{{1.5F, -2.0F, 3.25F}, {1, 2, 3}},
                                         {{0.0F, 0.5F, -1.0F}, {10, 13, 26}}};
  WritePointCloud(folder / "map.ply", points, "a comment");
  EXPECT_THAT(ReadPlyPoints(folder / "map.ply"),
              ElementsAre(Eigen::Vector3d(1.5, -2.0, 3.25), Eigen::Vector3d(0.0, 0.5, -1.0)));
}

TEST(ReadPlyPoints, SaysWhatIsWrongWithAFile) {
  const TestFolder folder;
  const std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex 2\n";
  const std::string axes = "property float x\nproperty float y\nproperty float z\nend_header\n";
  const auto problem = [&](const std::string& text) {
    return MessageOf([&] { ReadPlyPoints(folder.Write("map.ply", text)); });
  };
  EXPECT_THAT(problem("plain text"), HasSubstr("map.ply: is no PLY file"));
  EXPECT_THAT(problem(header), HasSubstr("end of its header"));
  EXPECT_THAT(problem(header + axes + "too short"), HasSubstr("ends before its last point"));
  EXPECT_THAT(problem(header + "property list uchar int i\n" + axes), HasSubstr("type 'list'"));
  EXPECT_THAT(problem(header + "property float x\nend_header\n"), HasSubstr("property y"));
  EXPECT_THAT(problem("ply\nformat ascii 1.0\nelement vertex 0\n" + axes),
              HasSubstr("binary_little_endian"));
  EXPECT_THAT(MessageOf([&] { ReadPlyPoints(folder / "none.ply"); }), HasSubstr("none.ply"));
}

TEST(EvaluateLoops, CallsFalseWhatIsOffInPlaceOrAngle) {
  const SceneTruth truth = test::TruthOf({.duration_s = 2.0, .stays = {}, .changes = {}});
  const Stamp match = truth.trajectory[2].stamp;
  const Stamp query = truth.trajectory[15].stamp;
  const Se3 good =
      truth.trajectory[2].T_world_camera.Inverse() * truth.trajectory[15].T_world_camera;
  Se3 shifted = good;
  shifted.translation.x() += 0.21;
  Se3 turned = good;
  turned.rotation = good.rotation * Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX());
  const LoopEvaluation evaluation = EvaluateLoops(
      truth.trajectory,
      {{query, match, good}, {query, match, shifted}, {query, match, turned}, {{}, match, good}});
  ASSERT_EQ(evaluation.loops.size(), 3U);
  EXPECT_FALSE(evaluation.loops[0].is_false);
  EXPECT_TRUE(evaluation.loops[1].is_false);
  EXPECT_NEAR(evaluation.loops[1].error_m, 0.21, 1e-9);
  EXPECT_TRUE(evaluation.loops[2].is_false);
  EXPECT_EQ(evaluation.num_false, 2);
  EXPECT_EQ(evaluation.num_without_truth, 1);
}

// A run folder whose world is turned and shifted against the truth's.
class RunFolder : public testing::Test {
 protected:
  RunFolder() : truth_(test::TruthOf({.duration_s = 3.0, .stays = {}, .changes = {}})) {
    Trajectory run = truth_.trajectory;
    for (StampedPose& pose : run)
      pose.T_world_camera = T_run_truth_ * pose.T_world_camera;
    WriteTrajectory(folder_ / "trajectory.txt", run);
  }

  TestFolder folder_;
  SceneTruth truth_;
  Se3 T_run_truth_{Eigen::Quaterniond(0.6, 0.0, 0.8, 0.0), {3.0, -1.0, 0.5}};
};

TEST_F(RunFolder, IsMovedIntoTheFrameOfTheTruth) {
  const Eigen::Vector3d place(0.5, 1.0, 3.0);
  ReportedObject object{.id = 1, .class_id = test::kChair, .state = "present"};
  object.centroid = object.box_center = T_run_truth_ * place;
  object.extent_min = object.extent_max = object.centroid;
  object.box_size_m = {0.2, 0.4, 0.6};
  object.box_rotation = T_run_truth_.rotation;
  WriteReportedObjects(folder_ / "objects.json", {.sequence = "test", .objects = {object}});
  ReportedChange change{.kind = ChangeKind::kRemoved, .object = 1, .class_id = test::kChair};
  change.from = object.centroid;
  WriteReportedChanges(folder_ / "changes.json", {.sequence = "test", .changes = {change}});
  const std::vector<ColoredPoint> points{{object.centroid.cast<float>(), {1, 2, 3}}};
  WritePointCloud(folder_ / "map.ply", points);
  const SceneRun run = ReadSceneRun(folder_.path(), truth_.trajectory);
  constexpr double kToleranceM = 1e-4;  // trajectory files round
  ASSERT_TRUE(run.objects && run.changes && run.map_points);
  EXPECT_FALSE(run.loops);
  EXPECT_LT((run.objects->at(0).centroid - place).norm(), kToleranceM);
  EXPECT_LT((run.objects->at(0).axis_extent.T_world_box.translation - place).norm(), kToleranceM);
  EXPECT_LT(AngleOf(run.objects->at(0).box.T_world_box), kToleranceM);
  EXPECT_LT((*run.changes->at(0).from - place).norm(), kToleranceM);
  EXPECT_LT((run.map_points->at(0) - place).norm(), kToleranceM);
  EXPECT_LT(run.ate_rmse_m, kToleranceM);
}

TEST_F(RunFolder, GivesAcceptedLoopsOnly) {
  const auto candidate = [](const std::string& verdict, const std::string& pose) {
    return R"({"query_stamp": "2.5", "match_stamp": "1.1", "query_map": 0, "match_map": 0,
      "verdict": ")" +
           verdict + R"(", "reason": "", "evidence": {}, "T_match_query": )" + pose + "}";
  };
  const std::string pose =
      R"({"tx_m": 1, "ty_m": 2, "tz_m": 3, "qx": 0, "qy": 0, "qz": 0, "qw": 1})";
  folder_.Write("loops.json", R"({"format": "loops", "version": 1, "candidates": [)" +
                                  candidate("refused", "null") + "," + candidate("closed", pose) +
                                  "," + candidate("merged", pose) + "]}");
  const SceneRun run = ReadSceneRun(folder_.path(), truth_.trajectory);
  ASSERT_TRUE(run.loops);
  ASSERT_EQ(run.loops->size(), 2U);
  EXPECT_EQ(run.loops->at(0).query.ns, 2'500'000'000);
  EXPECT_EQ(run.loops->at(0).T_match_query.translation, Eigen::Vector3d(1.0, 2.0, 3.0));
}

TEST_F(RunFolder, WithoutATrajectoryIsNamed) {
  EXPECT_THAT(MessageOf([&] { ReadSceneRun(folder_ / "none", truth_.trajectory); }),
              HasSubstr("none' holds no trajectory.txt"));
}

}  // namespace
}  // namespace cslam
