// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/correction.h"

#include "cslam/map/test_map.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

using test::MakeKeyframe;

Se3 Shift(double x, double y, double z) {
  return {Eigen::Quaterniond::Identity(), {x, y, z}};
}

// Map 0: keyframes 0 to 3 at x = 0 .. 3 m, each the parent of the next, points between neighbours.
// Map 1: keyframes 4 to 6 likewise.
class CorrectionTest : public testing::Test {
 protected:
  CorrectionTest() : map_(test::kLevelScales) {
    for (std::uint32_t id = 0; id < 7; ++id) {
      const bool is_first = id == 0 || id == 4;
      map_.AddKeyframe(MakeKeyframe(id, 20, id % 4, is_first ? KeyframeId() : KeyframeId(id - 1),
                                    MapId(id / 4)));
    }
    for (std::uint32_t id = 0; id < 7; ++id)
      points_.push_back(AddPoint(id, 0, {static_cast<double>(id % 4), 0.0, 4.0}));
    for (const std::uint32_t id : {0U, 1U, 2U, 4U, 5U}) {
      EXPECT_TRUE(map_.AddObservation(points_[id], KeyframeId(id + 1), 1));
      map_.RefreshAppearance(points_[id]);
    }
  }
  ~CorrectionTest() override { EXPECT_EQ(map_.CheckInvariants(), ""); }

  PointId AddPoint(std::uint32_t keyframe, int keypoint, const Eigen::Vector3d& p_world) {
    const PointId point = map_.AddPoint(p_world, KeyframeId(keyframe));
    EXPECT_TRUE(map_.AddObservation(point, KeyframeId(keyframe), keypoint));
    map_.RefreshAppearance(point);
    return point;
  }
  // Keyframe i of map 0 moves i cm up.
  MapCorrection LoopCorrection() const {
    MapCorrection correction;
    correction.epoch = map_.correction_epoch();
    correction.loop = {KeyframeId(0), KeyframeId(3), Shift(3.0, 0.0, 0.0)};
    correction.map = MapId(0);
    for (std::uint32_t i = 0; i < 4; ++i)
      correction.moves.push_back({KeyframeId(i), Shift(0.0, 0.01 * i, 0.0)});
    return correction;
  }
  double HeightOf(std::uint32_t keyframe) const {
    return map_.FindKeyframe(KeyframeId(keyframe))->T_world_camera.translation.y();
  }
  double HeightOf(PointId point) const { return map_.FindPoint(point)->p_world.y(); }

  Map map_;
  std::vector<PointId> points_;  // made by the keyframe of the same number
};

TEST_F(CorrectionTest, MovesKeyframesAndTheirPointsInOneStep) {
  const CorrectionReport report = ApplyCorrection(map_, LoopCorrection());
  EXPECT_TRUE(report.is_applied());
  for (std::uint32_t i = 0; i < 4; ++i) {
    EXPECT_DOUBLE_EQ(HeightOf(i), 0.01 * i);
    EXPECT_DOUBLE_EQ(HeightOf(points_[i]), 0.01 * i) << "moves with its reference keyframe";
  }
  EXPECT_DOUBLE_EQ(HeightOf(5), 0.0) << "of another map";
  EXPECT_EQ(report.keyframes_moved, 4);
  EXPECT_EQ(report.keyframes_carried, 0);
  EXPECT_EQ(report.points_moved, 4);
}

TEST_F(CorrectionTest, AppliesToPosesAsTheyAreByThen) {
  const MapCorrection correction = LoopCorrection();
  map_.SetPose(KeyframeId(2), Shift(2.1, 0.0, 0.0));  // refined in the meantime
  ApplyCorrection(map_, correction);
  EXPECT_TRUE(map_.FindKeyframe(KeyframeId(2))
                  ->T_world_camera.translation.isApprox(Eigen::Vector3d(2.1, 0.02, 0.0)));
}

TEST_F(CorrectionTest, CarriesKeyframesThatCameAfterTheSnapshotAlongTheirParents) {
  const MapCorrection correction = LoopCorrection();
  map_.AddKeyframe(MakeKeyframe(7, 20, 3.5, KeyframeId(3)));
  map_.AddKeyframe(MakeKeyframe(8, 20, 4.0, KeyframeId(7)));
  const PointId later = AddPoint(8, 5, {4.0, 0.0, 3.0});
  const CorrectionReport report = ApplyCorrection(map_, correction);
  EXPECT_DOUBLE_EQ(HeightOf(7), 0.03);
  EXPECT_DOUBLE_EQ(HeightOf(8), 0.03);
  EXPECT_DOUBLE_EQ(HeightOf(later), 0.03);
  EXPECT_EQ(report.keyframes_carried, 2);
}

TEST_F(CorrectionTest, LeavesOutKeyframesCulledSinceAndMovesWhatHungOnThem) {
  const MapCorrection correction = LoopCorrection();
  map_.AddKeyframe(MakeKeyframe(7, 20, 2.5, KeyframeId(2)));
  map_.CullKeyframe(KeyframeId(2));
  ApplyCorrection(map_, correction);
  EXPECT_DOUBLE_EQ(HeightOf(3), 0.03);
  EXPECT_DOUBLE_EQ(HeightOf(7), 0.01) << "with the parent of its culled parent";
  EXPECT_DOUBLE_EQ(map_.T_world_keyframe(KeyframeId(2))->translation.y(), 0.01);
}

TEST_F(CorrectionTest, AcceptsALoopWhoseKeyframesHaveBeenCulled) {
  const MapCorrection correction = LoopCorrection();
  map_.CullKeyframe(KeyframeId(3));
  EXPECT_TRUE(ApplyCorrection(map_, correction).is_applied());
}

TEST_F(CorrectionTest, FusesPairsAndAddsFoundPoints) {
  MapCorrection correction = LoopCorrection();
  correction.pairs = {{points_[0], points_[3]}};
  correction.found = {{points_[0], KeyframeId(2), 7}, {points_[1], KeyframeId(3), 9}};
  const CorrectionReport report = ApplyCorrection(map_, correction);
  EXPECT_EQ(report.points_fused, 1);
  EXPECT_EQ(report.observations_added, 2);
  EXPECT_EQ(map_.Resolve(points_[3]), points_[0]);
  EXPECT_EQ(map_.FindKeyframe(KeyframeId(3))->points[0], points_[0]);
  EXPECT_EQ(map_.FindKeyframe(KeyframeId(2))->points[7], points_[0]);
}

TEST_F(CorrectionTest, TakesStalePointsAndKeyframesForNormal) {
  MapCorrection correction = LoopCorrection();
  correction.pairs = {{points_[0], points_[3]}, {points_[1], PointId(999)}};
  correction.found = {{points_[0], KeyframeId(2), 7},    // the keyframe goes
                      {points_[2], KeyframeId(3), 9},    // holds another point by then
                      {points_[5], KeyframeId(3), 11}};  // of another map
  map_.CullKeyframe(KeyframeId(2));
  map_.ErasePoint(points_[0]);
  const PointId other = AddPoint(3, 9, {3.0, 0.0, 4.0});
  const CorrectionReport report = ApplyCorrection(map_, correction);
  EXPECT_TRUE(report.is_applied());
  EXPECT_EQ(report.points_fused, map_.Resolve(other) == points_[2] ? 1 : 0);
  EXPECT_EQ(report.observations_added, 0);
}

TEST_F(CorrectionTest, IsRefusedWithoutAChangeWhenAnotherCameBefore) {
  const MapCorrection first = LoopCorrection();
  const MapCorrection second = LoopCorrection();
  ApplyCorrection(map_, first);
  const CorrectionReport report = ApplyCorrection(map_, second);
  EXPECT_EQ(report.refusal, "the map was corrected in the meantime");
  EXPECT_DOUBLE_EQ(HeightOf(3), 0.03);
}

TEST_F(CorrectionTest, IsRefusedWhenTheMapIsGone) {
  MapCorrection correction = LoopCorrection();
  map_.Clear();
  EXPECT_FALSE(ApplyCorrection(map_, correction).is_applied());
  correction.epoch = map_.correction_epoch();
  EXPECT_EQ(ApplyCorrection(map_, correction).refusal, "map 0 is gone");
}

TEST_F(CorrectionTest, MergesOneMapIntoTheOther) {
  MapCorrection correction;
  correction.loop = {KeyframeId(1), KeyframeId(6), Shift(0.0, 0.0, 0.0)};
  correction.map = MapId(1);
  correction.merge_into = MapId(0);
  for (std::uint32_t i = 4; i < 7; ++i)
    correction.moves.push_back({KeyframeId(i), Shift(-1.0, 0.5, 0.0)});
  correction.pairs = {{points_[1], points_[6]}};
  map_.AddKeyframe(MakeKeyframe(7, 20, 3.0, KeyframeId(6), MapId(1)));  // after the snapshot
  const PointId later = AddPoint(7, 3, {3.0, 0.0, 4.0});
  const CorrectionReport report = ApplyCorrection(map_, correction);
  EXPECT_TRUE(report.is_applied()) << report.refusal;
  EXPECT_EQ(report.points_fused, 1);
  for (std::uint32_t i = 4; i < 8; ++i) {
    EXPECT_EQ(map_.FindKeyframe(KeyframeId(i))->map, MapId(0));
    EXPECT_DOUBLE_EQ(HeightOf(i), 0.5);
  }
  EXPECT_EQ(map_.FindPoint(later)->map, MapId(0));
  EXPECT_DOUBLE_EQ(HeightOf(points_[4]), 0.5);
  EXPECT_DOUBLE_EQ(HeightOf(points_[0]), 0.0);
  const auto parent_of = [&](std::uint32_t id) {
    return map_.FindKeyframe(KeyframeId(id))->parent;
  };
  EXPECT_EQ(parent_of(6), KeyframeId(1));
  EXPECT_EQ(parent_of(5), KeyframeId(6)) << "the tree is turned round";
  EXPECT_EQ(parent_of(4), KeyframeId(5));
  EXPECT_EQ(parent_of(7), KeyframeId(6));
}

TEST_F(CorrectionTest, RefinementReplacesWhatIsUnchangedAndCarriesTheRest) {
  PoseRefinement refinement;
  refinement.epoch = map_.correction_epoch();
  refinement.map = MapId(0);
  for (std::uint32_t i = 0; i < 4; ++i) {
    const Se3 old = map_.FindKeyframe(KeyframeId(i))->T_world_camera;
    refinement.poses.push_back({KeyframeId(i), old, Shift(i, 0.01 * i, 0.0)});
    const Eigen::Vector3d p = map_.FindPoint(points_[i])->p_world;
    refinement.positions.push_back({points_[i], p, p + Eigen::Vector3d(0.0, 0.05, 0.0)});
  }
  refinement.outliers = {{points_[0], KeyframeId(1)}, {points_[0], KeyframeId(2)}};
  map_.SetPose(KeyframeId(2), Shift(2.1, 0.0, 0.0));
  map_.SetPosition(points_[1], {1.0, 0.3, 4.0});
  map_.AddKeyframe(MakeKeyframe(7, 20, 3.5, KeyframeId(3)));
  const PointId later = AddPoint(7, 5, {4.0, 0.0, 3.0});

  const CorrectionReport report = ApplyRefinement(map_, refinement);
  EXPECT_TRUE(report.is_applied());
  EXPECT_DOUBLE_EQ(HeightOf(1), 0.01);
  EXPECT_DOUBLE_EQ(HeightOf(2), 0.02);
  EXPECT_DOUBLE_EQ(map_.FindKeyframe(KeyframeId(2))->T_world_camera.translation.x(), 2.1);
  EXPECT_DOUBLE_EQ(HeightOf(7), 0.03);
  EXPECT_DOUBLE_EQ(HeightOf(points_[0]), 0.05);
  EXPECT_DOUBLE_EQ(HeightOf(points_[1]), 0.31) << "changed since: moves with keyframe 1";
  EXPECT_DOUBLE_EQ(HeightOf(later), 0.03);
  EXPECT_EQ(report.keyframes_carried, 2);
  EXPECT_EQ(report.observations_removed, 1);
}

TEST_F(CorrectionTest, OfTwoRefinementsOfOneSnapshotTheSecondIsRefused) {
  const KeyframeId id = map_.Keyframes().front();
  const Se3 before = map_.FindKeyframe(id)->T_world_camera;
  const Se3 after = Se3(Eigen::Quaterniond::Identity(), {0.1, 0.0, 0.0}) * before;
  PoseRefinement refinement;
  refinement.epoch = map_.correction_epoch();
  refinement.map = MapId(0);
  refinement.poses = {{id, before, after}};
  EXPECT_TRUE(ApplyRefinement(map_, refinement).is_applied());
  EXPECT_FALSE(ApplyRefinement(map_, refinement).is_applied());
  EXPECT_NEAR(Difference(map_.FindKeyframe(id)->T_world_camera, after).distance_m, 0.0, 1e-12);
}

TEST_F(CorrectionTest, RefinementIsRefusedAfterACorrection) {
  PoseRefinement refinement;
  refinement.epoch = map_.correction_epoch();
  refinement.map = MapId(0);
  ApplyCorrection(map_, LoopCorrection());
  EXPECT_FALSE(ApplyRefinement(map_, refinement).is_applied());
}

}  // namespace
}  // namespace cslam
