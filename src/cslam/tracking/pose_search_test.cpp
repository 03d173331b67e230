// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/tracking/pose_search.h"

#include "cslam/map/map.h"
#include "cslam/map/test_map.h"
#include "cslam/objects/test_depth.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

using test::SceneCamera;

constexpr int kNumPoints = 150;

// A map of one keyframe at the origin, and a frame that sees the same points from elsewhere.
class PoseSearchTest : public testing::Test {
 protected:
  PoseSearchTest() : map_(test::kLevelScales), search_(SceneCamera(), options_) {
    Rng rng(5);
    for (int i = 0; i < kNumPoints; ++i) {
      points_.emplace_back(rng.Uniform(-1.0, 1.0), rng.Uniform(-0.7, 0.7), rng.Uniform(2.0, 3.0));
      looks_.push_back(test::RandomDescriptor(rng));
    }
    frame_ = SeenFrom(T_world_camera_);
    Keyframe keyframe = test::MakeKeyframe(0, kNumPoints);
    auto data = std::make_shared<KeyframeData>(*keyframe.data);
    data->features = SeenFrom(Se3());
    keyframe.data = data;
    map_.AddKeyframe(std::move(keyframe));
    last_.data = data;
    for (int i = 0; i < kNumPoints; ++i) {
      const PointId id = map_.AddPoint(points_[static_cast<std::size_t>(i)], kKeyframe);
      map_.AddObservation(id, kKeyframe, i);
      map_.RefreshAppearance(id);
      last_.points.push_back(id);
    }
  }

  FrameFeatures SeenFrom(const Se3& T_world_camera) const {
    std::vector<test::Feature> features;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Vector3d p_camera = T_world_camera.Inverse() * points_[i];
      const Eigen::Vector2f uv = Project(SceneCamera(), p_camera).cast<float>();
      const double disparity_px = SceneCamera().fx * options_.depth.baseline_m / p_camera.z();
      features.push_back({.u = uv.x(),
                          .v = uv.y(),
                          .descriptor = looks_[i],
                          .disparity_px = static_cast<float>(disparity_px),
                          .depth_m = static_cast<float>(p_camera.z())});
    }
    return test::MakeFeatures(features);
  }
  double ErrorM(const PoseEstimate& estimate) const {
    return Difference(estimate.T_world_camera, T_world_camera_).distance_m;
  }
  PosePrediction Standstill() const { return {Se3(), Se3()}; }

  static constexpr KeyframeId kKeyframe{0};
  const Se3 T_world_camera_{ExpSo3({0.004, -0.005, 0.003}), {0.02, -0.01, 0.03}};
  const TrackerOptions options_;
  Map map_;
  const PoseSearch search_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Descriptor> looks_;
  FrameFeatures frame_;
  LastFrame last_;
};

TEST_F(PoseSearchTest, FindsThePoseNearThePrediction) {
  const auto found = search_.FromMotion(frame_, map_, last_, Standstill());
  ASSERT_TRUE(found.has_value());
  EXPECT_LT(ErrorM(*found), 1e-3);
  EXPECT_GT(found->num_map_inliers, kNumPoints * 9 / 10);
  EXPECT_EQ(found->num_provisional_inliers, 0);
}

TEST_F(PoseSearchTest, UsesTheLastFramesDepthWhereTheMapHasNoPointsYet) {
  last_.points.assign(kNumPoints, PointId());
  const auto found = search_.FromMotion(frame_, map_, last_, Standstill());
  ASSERT_TRUE(found.has_value());
  EXPECT_LT(ErrorM(*found), 1e-3);
  EXPECT_EQ(found->num_map_inliers, 0);
  EXPECT_GT(found->num_provisional_inliers, kNumPoints * 9 / 10);
}

TEST_F(PoseSearchTest, FindsNothingWherePredictionOrLooksAreWrong) {
  const Se3 elsewhere(Eigen::Quaterniond::Identity(), {0.5, 0.0, 0.0});
  EXPECT_FALSE(search_.FromMotion(frame_, map_, last_, {Se3(), elsewhere}).has_value());
  Rng rng(6);
  for (Descriptor& descriptor : frame_.descriptors)
    descriptor = test::RandomDescriptor(rng);
  EXPECT_FALSE(search_.FromMotion(frame_, map_, last_, Standstill()).has_value());
  EXPECT_FALSE(search_.FromKeyframe(frame_, map_, kKeyframe, Se3()).has_value());
}

TEST_F(PoseSearchTest, NeedsNoPredictionToFindWhatAKeyframeSees) {
  const auto found = search_.FromKeyframe(frame_, map_, kKeyframe, Se3());
  ASSERT_TRUE(found.has_value());
  EXPECT_LT(ErrorM(*found), 1e-3);
  EXPECT_FALSE(search_.FromKeyframe(frame_, map_, KeyframeId(7), Se3()).has_value());
}

TEST_F(PoseSearchTest, FindsThePoseAtARecognisedPlace) {
  PlaceHint hint;
  hint.reference = kKeyframe;
  hint.T_reference_camera = Se3(Eigen::Quaterniond::Identity(), {0.01, 0.0, 0.02});
  const auto found = search_.FromPlace(frame_, map_, hint);
  ASSERT_TRUE(found.has_value());
  EXPECT_LT(ErrorM(*found), 1e-3);
  hint.reference = KeyframeId(7);
  EXPECT_FALSE(search_.FromPlace(frame_, map_, hint).has_value());
}

TEST_F(PoseSearchTest, FindsTheRestOfTheLocalMap) {
  auto first = search_.FromMotion(frame_, map_, last_, Standstill());
  ASSERT_TRUE(first.has_value());
  constexpr std::size_t kKept = 30;
  for (std::size_t i = kKept; i < first->matches.size(); ++i)
    first->matches[i] = Landmark{};
  const LocalMapPose found = search_.WithLocalMap(frame_, map_, *first, KeyframeId());
  EXPECT_EQ(found.reference, kKeyframe);
  EXPECT_EQ(found.expected.size(), kNumPoints - kKept);
  EXPECT_GT(found.num_map_matches, kNumPoints * 9 / 10);
  EXPECT_GT(found.estimate.num_map_inliers, kNumPoints * 9 / 10);
  EXPECT_LT(ErrorM(found.estimate), 1e-3);
}

}  // namespace
}  // namespace cslam
