// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/motion_blur.h"

#include "cslam/sim/camera_path.h"
#include "cslam/sim/simulated_sequence.h"
#include "cslam/sim/test_scene.h"
#include "cslam/sim/test_world.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <numbers>

namespace cslam {
namespace {

Se3 ViewAt(double x_m) {
  return PoseAt({{x_m, 0.0, 1.0}, 0.5 * std::numbers::pi, 0.0});
}

TEST(FlowOf, FollowsTheMovingCameraByDepth) {
  const Camera camera = MakeSimulatedCamera(160, 120);
  const RenderedView view = Renderer(MakeTestScene(), camera).Render(ViewAt(0.0));
  const cv::Mat flow_px = FlowOf(view, camera, {ViewAt(-0.01), ViewAt(0.01), 0.02});
  // Things move against the camera: f 0.02 m / z to the left.
  EXPECT_NEAR(flow_px.at<cv::Vec2f>(60, 80)[0], -camera.fx * 0.02 / 1.8, 1e-3);
  EXPECT_NEAR(flow_px.at<cv::Vec2f>(5, 5)[0], -camera.fx * 0.02 / 3.0, 1e-3);
  EXPECT_NEAR(flow_px.at<cv::Vec2f>(60, 80)[1], 0.0, 1e-3);
}

TEST(FlowOf, FollowsWhatMovesBeforeARestingCamera) {
  const Camera camera = MakeSimulatedCamera(160, 120);
  const Se3 T_world_camera = PoseAt({{0.0, -2.5, 1.0}, 0.5 * std::numbers::pi, 0.0});
  const RenderedView view = Renderer(test::MakeTestWorld(), camera).Render(T_world_camera, 3.0);
  const cv::Mat flow_px = FlowOf(view, camera, {T_world_camera, T_world_camera, 0.01});
  const double z = static_cast<double>(view.depth_m.at<float>(60, 80));
  EXPECT_NEAR(flow_px.at<cv::Vec2f>(60, 80)[0], -camera.fx * 0.01 / z, 1e-2);  // 1 m/s to the left
  EXPECT_EQ(flow_px.at<cv::Vec2f>(60, 5), cv::Vec2f(0.0F, 0.0F));
}

TEST(BlurMotion, LeavesAStillPictureAsItIs) {
  const RenderedView view =
      Renderer(MakeTestScene(), MakeSimulatedCamera(160, 120)).Render(ViewAt(0.0));
  const cv::Mat still(view.bgr.size(), CV_32FC2, cv::Scalar(0.0, 0.0));
  EXPECT_EQ(cv::norm(view.bgr, BlurMotion(view.bgr, still), cv::NORM_L1), 0.0);
}

TEST(BlurMotion, SmearsEdgesOverTheLengthOfTheFlow) {
  cv::Mat step(20, 40, CV_8UC3, cv::Scalar::all(0));
  step.colRange(20, 40).setTo(cv::Scalar::all(200));
  const cv::Mat flow_px(step.size(), CV_32FC2, cv::Scalar(8.0, 0.0));
  const cv::Mat blurred = BlurMotion(step, flow_px);
  EXPECT_EQ(blurred.at<cv::Vec3b>(10, 14)[0], 0);
  EXPECT_EQ(blurred.at<cv::Vec3b>(10, 25)[0], 200);
  EXPECT_NEAR(blurred.at<cv::Vec3b>(10, 19)[0], 90, 20);
  for (int u = 15; u < 25; ++u)
    EXPECT_LE(blurred.at<cv::Vec3b>(10, u - 1)[0], blurred.at<cv::Vec3b>(10, u)[0]) << u;
  const cv::Mat along_edge(step.size(), CV_32FC2, cv::Scalar(0.0, 8.0));
  EXPECT_EQ(cv::norm(step, BlurMotion(step, along_edge), cv::NORM_L1), 0.0);
}

}  // namespace
}  // namespace cslam
