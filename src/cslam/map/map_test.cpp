// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/map/map.h"

#include "cslam/map/test_map.h"
#include "cslam/util/check.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace cslam {
namespace {

using test::MakeKeyframe;

// Keyframes 0, 1, 2 at x = 0, 1, 2 m with ten features each; each the parent of the next.
class MapTest : public testing::Test {
 protected:
  MapTest() : map_(test::kLevelScales) {
    map_.AddKeyframe(MakeKeyframe(0, 10, 0.0));
    map_.AddKeyframe(MakeKeyframe(1, 10, 1.0, k0_));
    map_.AddKeyframe(MakeKeyframe(2, 10, 2.0, k1_));
  }
  ~MapTest() override { EXPECT_EQ(map_.CheckInvariants(), ""); }

  // A point 4 m in front of the first keyframe, seen by the keyframes as keypoint.
  PointId AddSeenPoint(const std::vector<KeyframeId>& keyframes, int keypoint) {
    const PointId point = map_.AddPoint({0.0, 0.0, 4.0}, keyframes.front());
    for (const KeyframeId id : keyframes)
      EXPECT_TRUE(map_.AddObservation(point, id, keypoint));
    map_.RefreshAppearance(point);
    return point;
  }
  int Shared(KeyframeId a, KeyframeId b) const {
    for (const CovisibleKeyframe& c : map_.FindKeyframe(a)->covisible) {
      if (c.id == b) return c.shared_points;
    }
    return 0;
  }

  const KeyframeId k0_{0}, k1_{1}, k2_{2};
  Map map_;
};

TEST_F(MapTest, ObservationIsKnownToBothSidesAndCounted) {
  const PointId point = AddSeenPoint({k0_, k1_}, 3);
  EXPECT_EQ(map_.FindKeyframe(k0_)->points[3], point);
  EXPECT_EQ(map_.FindPoint(point)->observations,
            (std::vector<PointObservation>{{k0_, 3}, {k1_, 3}}));
  EXPECT_EQ(Shared(k0_, k1_), 1);
  EXPECT_EQ(Shared(k1_, k0_), 1);
  EXPECT_EQ(Shared(k1_, k2_), 0);
}

TEST_F(MapTest, ObservationIsRefusedWhereSomethingIsAlready) {
  const PointId first = AddSeenPoint({k0_}, 3);
  const PointId second = AddSeenPoint({k1_}, 3);
  EXPECT_FALSE(map_.AddObservation(second, k0_, 3)) << "the keypoint holds another point";
  EXPECT_FALSE(map_.AddObservation(first, k0_, 4)) << "the keyframe sees the point already";
  EXPECT_EQ(map_.FindPoint(first)->observations.size(), 1U);
  EXPECT_FALSE(map_.FindKeyframe(k0_)->points[4].valid());
}

TEST_F(MapTest, ObservationsAreSortedWhateverTheOrder) {
  const PointId point = map_.AddPoint({0, 0, 4}, k2_);
  for (const KeyframeId id : {k2_, k0_, k1_})
    EXPECT_TRUE(map_.AddObservation(point, id, 0));
  EXPECT_EQ(map_.FindPoint(point)->observations,
            (std::vector<PointObservation>{{k0_, 0}, {k1_, 0}, {k2_, 0}}));
}

TEST_F(MapTest, RemovingAnObservationUncountsItAndMovesTheReference) {
  const PointId point = AddSeenPoint({k0_, k1_, k2_}, 3);
  map_.RemoveObservation(point, k0_);
  EXPECT_FALSE(map_.FindKeyframe(k0_)->points[3].valid());
  EXPECT_EQ(Shared(k0_, k1_), 0);
  EXPECT_EQ(Shared(k1_, k2_), 1);
  EXPECT_EQ(map_.FindPoint(point)->reference, k1_);
  EXPECT_THROW(map_.RemoveObservation(point, k0_), InternalError);
}

TEST_F(MapTest, PointGoesWithItsLastObservation) {
  const PointId point = AddSeenPoint({k0_}, 3);
  EXPECT_EQ(map_.num_points(), 1U);
  map_.RemoveObservation(point, k0_);
  EXPECT_EQ(map_.FindPoint(point), nullptr);
  EXPECT_EQ(map_.Resolve(point), std::nullopt);
  EXPECT_EQ(map_.num_points(), 0U);
  EXPECT_EQ(map_.num_point_ids(), 1U) << "the id stays taken";
}

TEST_F(MapTest, ErasedPointIsForgottenByAllThatSawIt) {
  const PointId point = AddSeenPoint({k0_, k1_, k2_}, 3);
  map_.ErasePoint(point);
  for (const KeyframeId id : {k0_, k1_, k2_}) {
    EXPECT_FALSE(map_.FindKeyframe(id)->points[3].valid());
    EXPECT_TRUE(map_.FindKeyframe(id)->covisible.empty());
  }
  EXPECT_THROW(map_.ErasePoint(point), InternalError);
}

TEST_F(MapTest, FusedPointIsSeenByAllThatSawEither) {
  const PointId keep = AddSeenPoint({k0_, k1_}, 3);
  const PointId drop = AddSeenPoint({k1_, k2_}, 5);
  map_.AddSightings(drop, 9, 4);
  map_.FusePoints(keep, drop);
  EXPECT_EQ(map_.FindPoint(keep)->observations,
            (std::vector<PointObservation>{{k0_, 3}, {k1_, 3}, {k2_, 5}}))
      << "keyframe 1 saw both and keeps the one of keep";
  EXPECT_FALSE(map_.FindKeyframe(k1_)->points[5].valid());
  EXPECT_EQ(map_.FindPoint(keep)->times_expected, 1 + 1 + 9);
  EXPECT_EQ(map_.FindPoint(keep)->times_found, 1 + 1 + 4);
  EXPECT_EQ(map_.num_points(), 1U);
}

TEST_F(MapTest, FusedIdsForwardFromOneToTheNext) {
  const PointId a = AddSeenPoint({k0_}, 0);
  const PointId b = AddSeenPoint({k1_}, 1);
  const PointId c = AddSeenPoint({k2_}, 2);
  map_.FusePoints(b, a);
  map_.FusePoints(c, b);
  EXPECT_EQ(map_.Resolve(a), c);
  EXPECT_EQ(map_.Resolve(b), c);
  EXPECT_EQ(map_.FindPoint(a), nullptr);
  map_.ErasePoint(c);
  EXPECT_EQ(map_.Resolve(a), std::nullopt);
}

TEST_F(MapTest, FusingAPointWithItselfChangesNothing) {
  const PointId point = AddSeenPoint({k0_}, 0);
  map_.FusePoints(point, point);
  EXPECT_EQ(map_.Resolve(point), point);
}

TEST_F(MapTest, CulledKeyframeForwardsToItsParentWhereverThatGoes) {
  AddSeenPoint({k0_, k1_, k2_}, 3);
  const Se3 T_world_culled = map_.FindKeyframe(k1_)->T_world_camera;
  map_.CullKeyframe(k1_);
  EXPECT_EQ(map_.FindKeyframe(k1_), nullptr);
  EXPECT_EQ(map_.Resolve(k1_)->keyframe, k0_);
  EXPECT_EQ(map_.T_world_keyframe(k1_)->translation, T_world_culled.translation);
  EXPECT_EQ(map_.FindKeyframe(k2_)->parent, k0_);
  EXPECT_EQ(map_.num_keyframes(), 2U);

  const Se3 quarter_turn(
      Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2.0, Eigen::Vector3d::UnitZ())),
      {5.0, 0.0, 0.0});
  map_.SetPose(k0_, quarter_turn);
  EXPECT_TRUE(map_.T_world_keyframe(k1_)->translation.isApprox(Eigen::Vector3d(5, 1, 0)))
      << map_.T_world_keyframe(k1_)->translation.transpose();
}

TEST_F(MapTest, CulledKeyframesForwardFromOneToTheNext) {
  map_.AddKeyframe(MakeKeyframe(3, 10, 3.0, k2_));
  map_.CullKeyframe(k2_);
  map_.CullKeyframe(k1_);
  const auto anchored = map_.Resolve(k2_);
  ASSERT_TRUE(anchored.has_value());
  EXPECT_EQ(anchored->keyframe, k0_);
  EXPECT_TRUE(anchored->T_keyframe_self.translation.isApprox(Eigen::Vector3d(2, 0, 0)));
  EXPECT_EQ(map_.FindKeyframe(KeyframeId(3))->parent, k0_);
}

TEST_F(MapTest, FirstKeyframeOfAMapIsNotCulled) {
  EXPECT_THROW(map_.CullKeyframe(k0_), InternalError);
}

TEST_F(MapTest, PointsSeenByTheCulledKeyframeOnlyAreErased) {
  const PointId lonely = AddSeenPoint({k1_}, 0);
  const PointId shared = AddSeenPoint({k1_, k2_}, 1);
  map_.CullKeyframe(k1_);
  EXPECT_EQ(map_.FindPoint(lonely), nullptr);
  ASSERT_NE(map_.FindPoint(shared), nullptr);
  EXPECT_EQ(map_.FindPoint(shared)->reference, k2_);
}

TEST_F(MapTest, ForwardStandsForAPoseFromTheStart) {
  const Se3 T_forward_self(Eigen::Quaterniond::Identity(), {0.0, 0.5, 0.0});
  map_.AddForward(KeyframeId(7), k2_, T_forward_self);
  EXPECT_EQ(map_.FindKeyframe(KeyframeId(7)), nullptr);
  EXPECT_TRUE(
      map_.T_world_keyframe(KeyframeId(7))->translation.isApprox(Eigen::Vector3d(2.0, 0.5, 0.0)));
  EXPECT_EQ(map_.Resolve(KeyframeId(5)), std::nullopt) << "skipped ids never existed";
}

TEST_F(MapTest, SkippedAndUnknownIdsResolveToNothing) {
  map_.AddKeyframe(MakeKeyframe(9, 10, 3.0, k2_));
  EXPECT_EQ(map_.num_keyframe_ids(), 10U);
  EXPECT_EQ(map_.num_keyframes(), 4U);
  for (const KeyframeId id : {KeyframeId(5), KeyframeId(99), KeyframeId()}) {
    EXPECT_EQ(map_.FindKeyframe(id), nullptr);
    EXPECT_EQ(map_.T_world_keyframe(id), std::nullopt);
  }
  EXPECT_EQ(map_.FindPoint(PointId()), nullptr);
  EXPECT_EQ(map_.Resolve(PointId(99)), std::nullopt);
  EXPECT_EQ(map_.Keyframes(), (std::vector{k0_, k1_, k2_, KeyframeId(9)}));
}

TEST_F(MapTest, KeyframeIdsAreNeverUsedTwice) {
  EXPECT_THROW(map_.AddKeyframe(MakeKeyframe(2, 10)), InternalError);
  EXPECT_THROW(map_.AddForward(k2_, k0_, Se3()), InternalError);
}

TEST_F(MapTest, NeighboursAreThoseThatShareMostFirst) {
  AddSeenPoint({k0_, k1_, k2_}, 0);
  AddSeenPoint({k0_, k2_}, 1);
  AddSeenPoint({k0_, k2_}, 2);
  EXPECT_EQ(map_.Neighbours(k0_, 1, 9), (std::vector<CovisibleKeyframe>{{k2_, 3}, {k1_, 1}}));
  EXPECT_EQ(map_.Neighbours(k0_, 2, 9), (std::vector<CovisibleKeyframe>{{k2_, 3}}));
  EXPECT_EQ(map_.Neighbours(k0_, 1, 1), (std::vector<CovisibleKeyframe>{{k2_, 3}}));
  EXPECT_EQ(map_.Neighbours(k1_, 1, 9), (std::vector<CovisibleKeyframe>{{k0_, 1}, {k2_, 1}}))
      << "equals by id";
  EXPECT_TRUE(map_.Neighbours(KeyframeId(9), 1, 9).empty());
}

TEST_F(MapTest, NumbersThatAreNoneAreRefused) {
  const PointId point = AddSeenPoint({k0_}, 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(map_.SetPosition(point, {0.0, nan, 0.0}), InternalError);
  EXPECT_THROW(map_.SetPose(k0_, Se3(Eigen::Quaterniond::Identity(), {nan, 0.0, 0.0})),
               InternalError);
  EXPECT_THROW(map_.AddPoint({nan, 0.0, 0.0}, k0_), InternalError);
}

TEST_F(MapTest, AppearanceIsThatOfTheMiddleObservation) {
  const PointId point = AddSeenPoint({k0_}, 0);
  const FrameFeatures& features = map_.FindKeyframe(k0_)->data->features;
  EXPECT_EQ(map_.FindPoint(point)->descriptor, features.descriptors[0]);
}

TEST_F(MapTest, GeometryTellsFromWhereAndHowFarAPointIsRecognised) {
  const PointId point = AddSeenPoint({k0_}, 0);
  map_.SetPosition(point, {0.0, 3.0, 4.0});
  map_.RefreshGeometry(point);
  const int octave = map_.FindKeyframe(k0_)->data->features.keypoints[0].octave;
  const double scale = test::kLevelScales[static_cast<std::size_t>(octave)];
  const MapPoint& p = *map_.FindPoint(point);
  EXPECT_TRUE(p.normal.isApprox(Eigen::Vector3f(0.0F, 0.6F, 0.8F)));
  EXPECT_NEAR(static_cast<double>(p.max_distance_m), 5.0 * scale, 1e-5);
  EXPECT_NEAR(static_cast<double>(p.min_distance_m), 5.0 * scale / 1.44, 1e-5);
}

TEST_F(MapTest, SnapshotStaysAsItWas) {
  const PointId kept = AddSeenPoint({k0_, k1_}, 3);
  const PointId fused = AddSeenPoint({k1_, k2_}, 5);
  const MapView before = map_.Snapshot();
  map_.SetPosition(kept, {9.0, 9.0, 9.0});
  map_.SetPose(k0_, Se3(Eigen::Quaterniond::Identity(), {9.0, 0.0, 0.0}));
  map_.FusePoints(kept, fused);
  map_.CullKeyframe(k2_);
  map_.AddKeyframe(MakeKeyframe(3, 10, 3.0, k1_));
  AddSeenPoint({KeyframeId(3)}, 0);

  EXPECT_EQ(before.FindPoint(kept)->p_world, Eigen::Vector3d(0, 0, 4));
  EXPECT_EQ(before.FindPoint(kept)->observations.size(), 2U);
  EXPECT_EQ(before.Resolve(fused), fused);
  EXPECT_EQ(before.FindKeyframe(k0_)->T_world_camera.translation.x(), 0.0);
  ASSERT_NE(before.FindKeyframe(k2_), nullptr);
  EXPECT_EQ(before.FindKeyframe(k2_)->points[5], fused);
  EXPECT_EQ(before.FindKeyframe(KeyframeId(3)), nullptr);
  EXPECT_EQ(before.num_keyframes(), 3U);
  EXPECT_EQ(before.num_points(), 2U);
  EXPECT_EQ(before.num_point_ids(), 2U);
}

TEST_F(MapTest, ClearForgetsAllButTheIds) {
  const PointId point = AddSeenPoint({k0_, k1_}, 3);
  map_.Clear();
  EXPECT_EQ(map_.num_keyframes(), 0U);
  EXPECT_EQ(map_.num_points(), 0U);
  EXPECT_EQ(map_.Resolve(point), std::nullopt);
  EXPECT_EQ(map_.Resolve(k1_), std::nullopt);
  EXPECT_THROW(map_.AddKeyframe(MakeKeyframe(2, 10)), InternalError);
  map_.AddKeyframe(MakeKeyframe(3, 10));
  EXPECT_GT(AddSeenPoint({KeyframeId(3)}, 0), point);
}

TEST_F(MapTest, TwoMapsLiveSideBySide) {
  map_.AddKeyframe(MakeKeyframe(3, 10, 0.0, {}, MapId(1)));
  const PointId elsewhere = AddSeenPoint({KeyframeId(3)}, 0);
  EXPECT_EQ(map_.FindPoint(elsewhere)->map, MapId(1));
  EXPECT_THROW(map_.AddObservation(elsewhere, k0_, 0), InternalError);
}

TEST_F(MapTest, MergingTurnsTheTreeOfTheMapThatGoes) {
  map_.AddKeyframe(MakeKeyframe(3, 10, 0.0, {}, MapId(1)));
  map_.AddKeyframe(MakeKeyframe(4, 10, 1.0, KeyframeId(3), MapId(1)));
  map_.AddKeyframe(MakeKeyframe(5, 10, 2.0, KeyframeId(4), MapId(1)));
  map_.AddKeyframe(MakeKeyframe(6, 10, 2.0, KeyframeId(3), MapId(1)));
  const PointId elsewhere = AddSeenPoint({KeyframeId(3)}, 0);
  map_.MergeMaps(MapId(0), MapId(1), k1_, KeyframeId(5));
  const auto parent_of = [&](std::uint32_t id) {
    return map_.FindKeyframe(KeyframeId(id))->parent;
  };
  EXPECT_EQ(parent_of(5), k1_);
  EXPECT_EQ(parent_of(4), KeyframeId(5));
  EXPECT_EQ(parent_of(3), KeyframeId(4));
  EXPECT_EQ(parent_of(6), KeyframeId(3));
  EXPECT_FALSE(parent_of(0).valid());
  for (std::uint32_t id = 0; id < 7; ++id)
    EXPECT_EQ(map_.FindKeyframe(KeyframeId(id))->map, MapId(0));
  EXPECT_EQ(map_.FindPoint(elsewhere)->map, MapId(0));
  EXPECT_TRUE(map_.AddObservation(elsewhere, k0_, 0));
}

TEST_F(MapTest, MapsAreMergedAtKeyframesOfTheirs) {
  map_.AddKeyframe(MakeKeyframe(3, 10, 0.0, {}, MapId(1)));
  const KeyframeId other(3);
  EXPECT_THROW(map_.MergeMaps(MapId(0), MapId(0), k0_, k1_), InternalError);
  EXPECT_THROW(map_.MergeMaps(MapId(0), MapId(1), other, k0_), InternalError);
  EXPECT_THROW(map_.MergeMaps(MapId(0), MapId(1), k0_, k1_), InternalError);
}

TEST_F(MapTest, EpochGrowsWithCorrectionsAndWhenAllIsForgotten) {
  const std::uint32_t before = map_.correction_epoch();
  map_.AdvanceCorrectionEpoch();
  EXPECT_EQ(map_.Snapshot().correction_epoch(), before + 1);
  map_.Clear();
  EXPECT_EQ(map_.correction_epoch(), before + 2);
}

}  // namespace
}  // namespace cslam
