// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/tracking/frame_matches.h"

#include "cslam/vision/test_features.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

using Kind = Landmark::Kind;

// Twenty keypoints of points in front of a camera at T_world_camera; every third is provisional.
class EstimatePoseTest : public testing::Test {
 protected:
  EstimatePoseTest() : T_world_camera_(ExpSo3({0.02, -0.03, 0.01}), {0.05, -0.02, 0.04}) {
    camera_.fx = camera_.fy = 500.0;
    camera_.cx = 320.0;
    camera_.cy = 240.0;
    Rng rng(11);
    std::vector<test::Feature> list;
    for (std::uint32_t i = 0; i < 20; ++i) {
      const Eigen::Vector3d p_camera(rng.Uniform(-1.0, 1.0), rng.Uniform(-0.8, 0.8),
                                     rng.Uniform(2.0, 4.0));
      const Eigen::Vector2f uv = Project(camera_, p_camera).cast<float>();
      list.push_back({.u = uv.x(),
                      .v = uv.y(),
                      .disparity_px = static_cast<float>(500.0 * kBaseline / p_camera.z())});
      const Kind kind = i % 3 == 0 ? Kind::kProvisional : Kind::kMapPoint;
      matches_.push_back({kind, PointId(i), false, T_world_camera_ * p_camera});
    }
    features_ = test::MakeFeatures(list);
  }
  PoseEstimate Estimate(Provisional provisional) const {
    return EstimatePose(features_, matches_, Se3(), provisional, camera_, kBaseline,
                        MeasurementModel({1.0, 1.2}, 1.0), PoseOptimizerOptions{});
  }
  static constexpr double kBaseline = 0.08;
  const Se3 T_world_camera_;
  Camera camera_;
  FrameFeatures features_;
  FrameMatches matches_;
};

TEST_F(EstimatePoseTest, FindsThePoseAndCountsBothKinds) {
  const PoseEstimate estimate = Estimate(Provisional::kUse);
  EXPECT_LT(Difference(estimate.T_world_camera, T_world_camera_).distance_m, 1e-4);
  EXPECT_EQ(estimate.num_map_inliers, 13);
  EXPECT_EQ(estimate.num_provisional_inliers, 7);
  EXPECT_EQ(estimate.num_inliers(), 20);
}

TEST_F(EstimatePoseTest, LeavesProvisionalOnesOutWhenTold) {
  const PoseEstimate estimate = Estimate(Provisional::kIgnore);
  EXPECT_EQ(estimate.num_map_inliers, 13);
  EXPECT_EQ(estimate.num_provisional_inliers, 0);
  EXPECT_EQ(CountMatches(estimate.matches, Kind::kProvisional), 0);
}

TEST_F(EstimatePoseTest, DropsTheMatchThatDisagrees) {
  matches_[4].p_world += Eigen::Vector3d(0.5, 0.0, 0.0);
  const PoseEstimate estimate = Estimate(Provisional::kUse);
  EXPECT_EQ(estimate.matches[4].kind, Kind::kNone);
  EXPECT_EQ(estimate.num_map_inliers, 12);
  EXPECT_LT(Difference(estimate.T_world_camera, T_world_camera_).distance_m, 1e-3);
}

TEST(PointIds, AreThoseOfMapPointsOnly) {
  FrameMatches matches(3);
  matches[0].kind = Kind::kMapPoint;
  matches[0].point = PointId(7);
  matches[1].kind = Kind::kProvisional;
  matches[1].point = PointId(8);
  EXPECT_EQ(PointIds(matches), (std::vector{PointId(7), PointId(), PointId()}));
  EXPECT_EQ(CountMatches(matches, Kind::kMapPoint), 1);
}

}  // namespace
}  // namespace cslam
