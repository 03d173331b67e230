// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/vision/frame_features.h"

#include "cslam/vision/test_features.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <algorithm>
#include <limits>

namespace cslam {
namespace {

Camera MakeCamera() {
  Camera camera;
  camera.fx = camera.fy = 500.0;
  camera.cx = 320.0;
  camera.cy = 240.0;
  return camera;
}

RgbdFrame MakeFrame(float depth_m) {
  RgbdFrame frame;
  frame.gray = cv::Mat(480, 640, CV_8UC1, cv::Scalar(128));
  frame.depth_m = cv::Mat(480, 640, CV_32FC1, cv::Scalar(static_cast<double>(depth_m)));
  return frame;
}

// The one keypoint of a corner at (u, v).
Keypoint MeasureOne(const RgbdFrame& frame, float u, float v, const DepthOptions& options = {},
                    const Camera& camera = MakeCamera()) {
  OrbFeatures orb;
  orb.corners.push_back({.u = u, .v = v, .angle_rad = 1.5F, .response = 9.0F, .octave = 3});
  orb.descriptors.emplace_back();
  const auto features =
      MeasureFeatures(std::move(orb), frame, camera, UndistortedBounds(camera), options);
  return features.keypoints.at(0);
}

TEST(MeasureFeatures, TurnsDepthIntoDisparity) {
  const Keypoint keypoint = MeasureOne(MakeFrame(2.0F), 100.0F, 50.0F, {.baseline_m = 0.1});
  EXPECT_FLOAT_EQ(keypoint.depth_m, 2.0F);
  EXPECT_FLOAT_EQ(keypoint.disparity_px, 500.0F * 0.1F / 2.0F);
  EXPECT_EQ(keypoint.octave, 3);
  EXPECT_FLOAT_EQ(keypoint.angle_rad, 1.5F);
}

TEST(MeasureFeatures, ReadsDepthAtTheNearestRawPixel) {
  RgbdFrame frame = MakeFrame(2.0F);
  frame.depth_m.at<float>(50, 101) = 2.05F;
  EXPECT_FLOAT_EQ(MeasureOne(frame, 100.6F, 49.7F).depth_m, 2.05F);
  EXPECT_FLOAT_EQ(MeasureOne(frame, 100.4F, 49.7F).depth_m, 2.0F);
}

TEST(MeasureFeatures, UndistortsTheKeypointButNotWhereDepthIsRead) {
  Camera camera = MakeCamera();
  camera.k1 = 0.2;
  RgbdFrame frame = MakeFrame(2.0F);
  frame.depth_m.at<float>(40, 600) = 2.05F;
  const Keypoint keypoint = MeasureOne(frame, 600.0F, 40.0F, {}, camera);
  EXPECT_FLOAT_EQ(keypoint.depth_m, 2.05F);
  EXPECT_EQ(keypoint.raw_px, Eigen::Vector2f(600.0F, 40.0F));
  const Eigen::Vector2d expected = Undistort(camera, {600.0, 40.0});
  EXPECT_NEAR(static_cast<double>(keypoint.uv_px.x()), expected.x(), 1e-3);
  EXPECT_GT((keypoint.uv_px - keypoint.raw_px).norm(), 1.0F);
}

TEST(MeasureFeatures, HasNoDepthWhereTheReadingIsUnusable) {
  for (const float depth : {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::infinity(), 0.3F, 7.0F}) {
    const Keypoint keypoint =
        MeasureOne(MakeFrame(depth), 100, 100, {.min_depth_m = 0.5, .max_depth_m = 6.0});
    EXPECT_FALSE(keypoint.HasDepth()) << depth;
    EXPECT_LT(keypoint.disparity_px, 0.0F) << depth;
  }
}

TEST(MeasureFeatures, HasNoDepthWhereTheSurfaceBreaksOff) {
  RgbdFrame frame = MakeFrame(2.0F);
  frame.depth_m.colRange(320, 640) = cv::Scalar(3.0);
  const DepthOptions options{.edge_radius_px = 4, .max_edge_ratio = 0.1};
  EXPECT_FALSE(MeasureOne(frame, 317, 100, options).HasDepth());
  EXPECT_FALSE(MeasureOne(frame, 322, 100, options).HasDepth());
  EXPECT_TRUE(MeasureOne(frame, 310, 100, options).HasDepth());
  EXPECT_TRUE(MeasureOne(frame, 317, 100, {.edge_radius_px = 0}).HasDepth());
}

TEST(MeasureFeatures, ReadsInsideTheImageForCornersOnItsBorder) {
  EXPECT_TRUE(MeasureOne(MakeFrame(2.0F), 639.4F, 479.4F).HasDepth());
  EXPECT_TRUE(MeasureOne(MakeFrame(2.0F), -0.4F, -0.4F).HasDepth());
}

TEST(MeasureFeatures, TakesAFrameWithoutDepth) {
  RgbdFrame frame = MakeFrame(2.0F);
  frame.depth_m = cv::Mat();
  EXPECT_FALSE(MeasureOne(frame, 100, 100).HasDepth());
}

TEST(KeypointGrid, VisitsAllKeypointsNearByOnce) {
  Rng rng(5);
  std::vector<test::Feature> list;
  for (int i = 0; i < 500; ++i) {
    list.push_back({.u = static_cast<float>(rng.Uniform(-5.0, 645.0)),
                    .v = static_cast<float>(rng.Uniform(-5.0, 485.0))});
  }
  const FrameFeatures features = test::MakeFeatures(list);
  for (int round = 0; round < 50; ++round) {
    const Eigen::Vector2f at(static_cast<float>(rng.Uniform(-20.0, 660.0)),
                             static_cast<float>(rng.Uniform(-20.0, 500.0)));
    const auto radius = static_cast<float>(rng.Uniform(1.0, 60.0));
    std::vector<int> visits(list.size(), 0);
    features.grid.VisitNear(at, radius, [&](int i) { ++visits[static_cast<std::size_t>(i)]; });
    EXPECT_LE(*std::max_element(visits.begin(), visits.end()), 1);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Eigen::Vector2f offset = features.keypoints[i].uv_px - at;
      if (offset.cwiseAbs().maxCoeff() <= radius) {
        EXPECT_EQ(visits[i], 1) << list[i].u << ' ' << list[i].v;
      }
    }
  }
}

}  // namespace
}  // namespace cslam
