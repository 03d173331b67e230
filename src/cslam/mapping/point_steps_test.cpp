// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// Triangulation, fusion and culling of points on exact views of forty known points.
#include "cslam/map/test_map.h"
#include "cslam/mapping/culling.h"
#include "cslam/mapping/fusion.h"
#include "cslam/mapping/point_creation.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

constexpr int kNumPoints = 40;
constexpr int kNumShared = 20;  // the first ones are in the map from the start

// Keyframe i stands 0.3 * i metres to the right and sees point k as its keypoint k, without depth.
class PointStepsTest : public testing::Test {
 protected:
  PointStepsTest() : model_(test::kLevelScales, 1.0), map_(test::kLevelScales) {
    camera_.fx = camera_.fy = 500.0;
    camera_.cx = 320.0;
    camera_.cy = 240.0;
    Rng rng(21);
    for (int k = 0; k < kNumPoints; ++k) {
      points_.emplace_back(rng.Uniform(-0.7, 1.3), rng.Uniform(-0.9, 0.9), rng.Uniform(2.5, 4.0));
      looks_.push_back(test::RandomDescriptor(rng));
    }
    for (std::uint32_t i = 0; i < 3; ++i)
      AddView(i);
    for (int k = 0; k < kNumShared; ++k)
      AddTrue(k, {0, 1, 2});
  }
  ~PointStepsTest() override { EXPECT_EQ(map_.CheckInvariants(), ""); }

  void AddView(std::uint32_t id) {
    Keyframe keyframe = test::MakeKeyframe(id, 0, 0.3 * id, id == 0 ? KeyframeId() : KeyframeId(0));
    std::vector<test::Feature> list;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const Eigen::Vector3d p_camera = keyframe.T_world_camera.Inverse() * points_[k];
      const Eigen::Vector2f uv = Project(camera_, p_camera).cast<float>();
      list.push_back({.u = uv.x(), .v = uv.y(), .descriptor = looks_[k]});
    }
    auto data = std::make_shared<KeyframeData>(*keyframe.data);
    data->features = test::MakeFeatures(list);
    keyframe.data = std::move(data);
    map_.AddKeyframe(std::move(keyframe));
  }
  PointId AddTrue(int k, const std::vector<std::uint32_t>& keyframes) {
    const PointId id =
        map_.AddPoint(points_[static_cast<std::size_t>(k)], KeyframeId(keyframes.front()));
    for (const std::uint32_t keyframe : keyframes)
      map_.AddObservation(id, KeyframeId(keyframe), k);
    map_.RefreshAppearance(id);
    return id;
  }
  std::vector<PointId> Triangulate(const TriangulationOptions& options = {}) {
    return TriangulatePoints(map_, KeyframeId(2), camera_, model_, 15, options);
  }
  int Fuse() {
    return FuseWithNeighbours(map_, KeyframeId(2), camera_, UndistortedBounds(camera_), {}, model_,
                              15, {});
  }

  Camera camera_;
  const MeasurementModel model_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Descriptor> looks_;
  Map map_;
};

TEST_F(PointStepsTest, TriangulatesWhatHasNoPointYet) {
  const std::vector<PointId> created = Triangulate();
  EXPECT_EQ(created.size(), static_cast<std::size_t>(kNumPoints - kNumShared));
  for (const PointId id : created) {
    const MapPoint& point = *map_.FindPoint(id);
    ASSERT_EQ(point.observations.size(), 2U);
    const auto k = static_cast<std::size_t>(point.observations[0].keypoint);
    EXPECT_LT((point.p_world - points_[k]).norm(), 1e-3);
    EXPECT_EQ(point.created_by, KeyframeId(2));
  }
}

TEST_F(PointStepsTest, TriangulatesNothingOverTooShortABaseline) {
  EXPECT_TRUE(Triangulate({.min_baseline_m = 0.7}).empty());
}

TEST_F(PointStepsTest, TriangulatesNothingWithTooLittleParallax) {
  EXPECT_TRUE(Triangulate({.min_parallax_deg = 30.0}).empty()) << "and there is no depth either";
}

TEST_F(PointStepsTest, TriangulatesNoLookalikesOffTheEpipolarLine) {
  Keyframe moved = test::MakeKeyframe(3, 0, 0.9, KeyframeId(0));
  auto data = std::make_shared<KeyframeData>(*map_.FindKeyframe(KeyframeId(2))->data);
  for (std::size_t k = kNumShared; k < kNumPoints; ++k)
    data->features.keypoints[k].uv_px.y() += 12.0F;
  moved.data = std::move(data);
  map_.AddKeyframe(std::move(moved));
  for (int k = 0; k < kNumShared; ++k)
    map_.AddObservation(map_.FindKeyframe(KeyframeId(0))->points[static_cast<std::size_t>(k)],
                        KeyframeId(3), k);
  EXPECT_TRUE(TriangulatePoints(map_, KeyframeId(3), camera_, model_, 15, {}).empty());
}

TEST_F(PointStepsTest, DynamicKeypointsMakeNoPoints) {
  Keyframe keyframe = test::MakeKeyframe(3, 0, 0.0, KeyframeId(0));
  auto data = std::make_shared<KeyframeData>(*map_.FindKeyframe(KeyframeId(0))->data);
  for (std::size_t k = 0; k < kNumPoints; ++k) {
    data->features.keypoints[k].depth_m = 2.0F;
    data->features.semantics[k].label = k < 10 ? KeypointLabel::kStatic : KeypointLabel::kDynamic;
  }
  keyframe.data = std::move(data);
  map_.AddKeyframe(std::move(keyframe));
  EXPECT_EQ(CreatePointsFromDepth(map_, KeyframeId(3), camera_, {}, 1000).size(), 10U);
}

TEST_F(PointStepsTest, FusesTwoPointsThatAreOne) {
  const PointId twice_seen = AddTrue(30, {0, 1});
  const PointId once_seen = AddTrue(30, {2});
  EXPECT_GE(Fuse(), 1);
  EXPECT_EQ(map_.Resolve(once_seen), twice_seen) << "the better observed is kept";
  EXPECT_EQ(map_.FindPoint(twice_seen)->observations.size(), 3U);
}

TEST_F(PointStepsTest, FindsANeighboursPointInAFreeKeypoint) {
  const PointId point = AddTrue(30, {0, 1});
  EXPECT_EQ(Fuse(), 1);
  EXPECT_EQ(map_.FindKeyframe(KeyframeId(2))->points[30], point);
}

TEST_F(PointStepsTest, LeavesPointsApartThatShowElsewhereOrLookDifferent) {
  const PointId here = AddTrue(30, {0, 1});
  const PointId there = AddTrue(31, {2});
  map_.RemoveObservation(there, KeyframeId(2));
  map_.SetPosition(here, points_[30] + Eigen::Vector3d(0.2, 0.0, 0.0));
  map_.RefreshGeometry(here);
  EXPECT_EQ(Fuse(), 0);
}

TEST_F(PointStepsTest, PointSeenOnceIsErasedTwoKeyframesLater) {
  const PointId lonely = AddTrue(30, {0});
  const PointId seen = AddTrue(31, {0, 1});
  const std::vector on_probation{lonely, seen};
  const PointCulling soon = CullPointsOnProbation(map_, on_probation, KeyframeId(1), {});
  EXPECT_EQ(soon.num_erased, 0);
  EXPECT_EQ(soon.still_on_probation, on_probation);
  const PointCulling later = CullPointsOnProbation(map_, on_probation, KeyframeId(2), {});
  EXPECT_EQ(later.num_erased, 1);
  EXPECT_EQ(later.still_on_probation, std::vector{seen});
  const PointCulling last = CullPointsOnProbation(map_, on_probation, KeyframeId(3), {});
  EXPECT_TRUE(last.still_on_probation.empty()) << "past probation, and the dead are skipped";
  EXPECT_NE(map_.FindPoint(seen), nullptr);
}

TEST_F(PointStepsTest, PointRarelyFoundIsErased) {
  const PointId rarely = AddTrue(30, {0, 1, 2});
  map_.AddSightings(rarely, 99, 23);  // 24 of 100
  const PointId often = AddTrue(31, {0, 1, 2});
  map_.AddSightings(often, 99, 24);  // 25 of 100
  EXPECT_EQ(CullPointsOnProbation(map_, {rarely, often}, KeyframeId(0), {}).num_erased, 1);
  EXPECT_EQ(map_.FindPoint(rarely), nullptr);
}

}  // namespace
}  // namespace cslam
