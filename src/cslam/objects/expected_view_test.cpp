// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/expected_view.h"

#include "cslam/objects/test_depth.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace cslam {
namespace {

using test::DrawPanel;
using test::ViewOf;
using test::Wall;

// A panel of 0.6 m x 0.6 m, 2 m in front of the camera, as it was seen once.
std::vector<Eigen::Vector3f> PanelSamples() {
  std::vector<Eigen::Vector3f> samples;
  for (float y = -0.27F; y < 0.28F; y += 0.06F) {
    for (float x = -0.27F; x < 0.28F; x += 0.06F)
      samples.emplace_back(x, y, 2.0F);
  }
  return samples;
}

ExpectedView Look(const cv::Mat& depth_m, const Se3& T_camera_samples = {},
                  double pose_sigma_m = 0.0, const cv::Mat* others = nullptr) {
  const DepthView view = ViewOf(depth_m);
  const DepthSampler sampler{&view.depth_mm, view.step, &view.camera, false, others};
  return LookAtPlace(PanelSamples(), T_camera_samples, sampler, pose_sigma_m, {});
}

cv::Mat WithPanelAt(double depth, double x = 0.0, double width = 0.6) {
  cv::Mat depth_m = Wall(4.0);
  DrawPanel(depth_m, x, 0.0, depth, width, 0.6);
  return depth_m;
}

TEST(LookAtPlace, FindsStandingWhatStandsThere) {
  const ExpectedView view = Look(WithPanelAt(2.0));
  EXPECT_EQ(view.verdict, PlaceVerdict::kStanding);
  EXPECT_EQ(view.num_through, 0);
  EXPECT_EQ(view.num_samples, 100);
}

TEST(LookAtPlace, SeesTheWallWhereItIsGone) {
  const ExpectedView view = Look(Wall(4.0));
  EXPECT_EQ(view.verdict, PlaceVerdict::kLookedThrough);
  EXPECT_EQ(view.num_through, 100);
  EXPECT_DOUBLE_EQ(view.through_share(), 1.0);
}

TEST(LookAtPlace, TakesHiddenForUnobserved) {
  const ExpectedView view = Look(WithPanelAt(1.0, 0.0, 1.5));
  EXPECT_EQ(view.verdict, PlaceVerdict::kUnobserved);
  EXPECT_GT(view.num_hidden, 50);
}

TEST(LookAtPlace, SeesThatItIsGoneByWhatShouldStickOut) {
  cv::Mat depth_m = Wall(4.0);
  DrawPanel(depth_m, 0.0, 0.04, 1.5, 0.6, 0.42);  // hides all but its upper rim
  const ExpectedView gone = Look(depth_m);
  EXPECT_GT(gone.num_hidden, 50);
  EXPECT_EQ(gone.verdict, PlaceVerdict::kLookedThrough);

  cv::Mat there_m = WithPanelAt(2.0);
  DrawPanel(there_m, 0.0, 0.04, 1.5, 0.6, 0.42);
  EXPECT_NE(Look(there_m).verdict, PlaceVerdict::kLookedThrough) << "its rim is there";
}

TEST(LookAtPlace, TakesOutOfViewForUnobserved) {
  const Se3 aside(Eigen::Quaterniond::Identity(), Eigen::Vector3d(5.0, 0.0, 0.0));
  const Se3 behind(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.0, 0.0, -4.0));
  for (const Se3& T : {aside, behind}) {
    const ExpectedView view = Look(Wall(4.0), T);
    EXPECT_EQ(view.verdict, PlaceVerdict::kUnobserved);
    EXPECT_EQ(view.num_outside, 100);
  }
}

TEST(LookAtPlace, TakesAPlaceThatIsMostlyCutOffForUnobserved) {
  const Se3 to_the_edge(Eigen::Quaterniond::Identity(), Eigen::Vector3d(1.3, 0.0, 0.0));
  const ExpectedView view = Look(Wall(4.0), to_the_edge);
  EXPECT_GT(view.num_through, 0);
  EXPECT_EQ(view.verdict, PlaceVerdict::kUnobserved);
}

TEST(LookAtPlace, TakesMissingDepthForUnobserved) {
  const ExpectedView view = Look(Wall(0.0));
  EXPECT_EQ(view.verdict, PlaceVerdict::kUnobserved);
  EXPECT_EQ(view.num_unclear, 100);
  const cv::Mat none;
  const Camera camera = test::SceneCamera();
  const DepthSampler sampler{&none, 4, &camera};
  EXPECT_EQ(LookAtPlace(PanelSamples(), Se3(), sampler, 0.0, {}).verdict,
            PlaceVerdict::kUnobserved);
}

TEST(LookAtPlace, SaysNothingOfPlacesTooFarAway) {
  const Se3 far(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.0, 0.0, 3.0));
  EXPECT_EQ(Look(Wall(9.0), far).verdict, PlaceVerdict::kUnobserved);
}

TEST(LookAtPlace, SaysNothingWithoutSamples) {
  const DepthView view = ViewOf(Wall(4.0));
  const DepthSampler sampler{&view.depth_mm, view.step, &view.camera};
  EXPECT_EQ(LookAtPlace({}, Se3(), sampler, 0.0, {}).verdict, PlaceVerdict::kUnobserved);
}

TEST(LookAtPlace, WantsLargerDifferencesOfUncertainPoses) {
  const cv::Mat just_behind = Wall(2.1);
  EXPECT_EQ(Look(just_behind).verdict, PlaceVerdict::kLookedThrough);
  EXPECT_EQ(Look(just_behind, {}, 0.15).verdict, PlaceVerdict::kStanding);
}

TEST(LookAtPlace, DoesNotLookThroughBesideAnEdge) {
  cv::Mat depth_m = Wall(4.0);
  for (int column = 0; column < depth_m.cols; column += 8)
    depth_m.colRange(column, column + 4).setTo(2.0);  // a railing: every other pixel of the view
  const ExpectedView view = Look(depth_m);
  EXPECT_EQ(view.num_through, 0);
  EXPECT_NE(view.verdict, PlaceVerdict::kLookedThrough);
}

TEST(LookAtPlace, DoesNotTakeAnotherThingForTheOneItLooksFor) {
  // A quarter is free, on the rest stands something of another kind.
  const cv::Mat depth_m = WithPanelAt(2.0, 0.12, 0.36);
  EXPECT_EQ(Look(depth_m).verdict, PlaceVerdict::kStanding);
  const cv::Mat others(120, 160, CV_8UC1, cv::Scalar(255));
  const ExpectedView view = Look(depth_m, {}, 0.0, &others);
  EXPECT_GT(view.num_taken, 40);
  EXPECT_EQ(view.num_standing, 0);
  EXPECT_EQ(view.verdict, PlaceVerdict::kLookedThrough);
}

TEST(LookAtPlace, DoesNotCallAPlaceEmptyThatAnotherThingFills) {
  const cv::Mat others(120, 160, CV_8UC1, cv::Scalar(255));
  EXPECT_EQ(Look(WithPanelAt(2.0), {}, 0.0, &others).verdict, PlaceVerdict::kTaken);
}

TEST(LookAtPlace, SkipsSamplesThatAreNoNumbers) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Eigen::Vector3f> samples{{nan, nan, nan}, {nan, 0.0F, 2.0F}};
  const DepthView view = ViewOf(Wall(4.0));
  const DepthSampler sampler{&view.depth_mm, view.step, &view.camera};
  EXPECT_EQ(LookAtPlace(samples, Se3(), sampler, 0.0, {}).num_visible(), 0);
}

TEST(FindStanding, CountsWhatTheRegionCovers) {
  const DepthView view = ViewOf(WithPanelAt(2.0));
  cv::Mat left_half = cv::Mat::zeros(view.depth_mm.size(), CV_8UC1);
  left_half(cv::Rect(0, 0, left_half.cols / 2, left_half.rows)).setTo(255);
  const StandingSurface standing = FindStanding(PanelSamples(), {}, view, left_half, {});
  EXPECT_EQ(standing.num_standing, 100);
  EXPECT_NEAR(standing.covered_share(), 0.5, 0.11);
  const DepthView empty = ViewOf(Wall(4.0));
  EXPECT_EQ(FindStanding(PanelSamples(), {}, empty, left_half, {}).covered_share(), 0.0);
}

}  // namespace
}  // namespace cslam
