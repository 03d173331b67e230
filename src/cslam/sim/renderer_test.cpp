// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/renderer.h"

#include "cslam/sim/camera_path.h"
#include "cslam/sim/simulated_sequence.h"
#include "cslam/sim/test_scene.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <numbers>

namespace cslam {
namespace {

// At (0, 0, 1), looking along +y at the box (1.8 m) and the wall (3 m) behind it.
Se3 ViewOfTheBox() {
  return PoseAt({{0.0, 0.0, 1.0}, 0.5 * std::numbers::pi, 0.0});
}

TEST(Renderer, MeasuresDepthAlongTheOpticalAxis) {
  const Renderer renderer(MakeTestScene(), MakeSimulatedCamera(160, 120));
  const RenderedView view = renderer.Render(ViewOfTheBox());
  ASSERT_EQ(view.depth_m.type(), CV_32FC1);
  EXPECT_NEAR(view.depth_m.at<float>(60, 80), 1.8F, 1e-5F);
  // The wall is as deep in the corner of the image as anywhere: z, not the distance.
  EXPECT_NEAR(view.depth_m.at<float>(0, 0), 3.0F, 1e-5F);
  EXPECT_NEAR(view.depth_m.at<float>(119, 159), 3.0F, 1e-5F);
}

TEST(Renderer, ShowsColorsAndInstancesOfWhatIsThere) {
  const Renderer renderer(MakeTestScene(), MakeSimulatedCamera(160, 120));
  const RenderedView view = renderer.Render(ViewOfTheBox());
  ASSERT_EQ(view.instances.type(), CV_16UC1);
  EXPECT_EQ(view.instances.at<std::uint16_t>(60, 80), 1);
  EXPECT_EQ(view.instances.at<std::uint16_t>(5, 5), 0);
  EXPECT_EQ(view.bgr.at<cv::Vec3b>(60, 80), cv::Vec3b(0, 0, 200));
  EXPECT_EQ(view.bgr.at<cv::Vec3b>(5, 5), cv::Vec3b(240, 240, 240));
  // The front face, 0.4 m at 1.8 m, ends 14.6 px from the centre (79.5, 59.5) on every side.
  EXPECT_EQ(cv::countNonZero(view.instances), 30 * 30);
}

TEST(Renderer, SmoothsEdgesInColorButNotInDepth) {
  const Renderer renderer(MakeTestScene(), MakeSimulatedCamera(160, 120));
  // Rolled, so that the box's edges run across the pixels.
  const Se3 T_world_camera = ViewOfTheBox() * Se3(ExpSo3({0.0, 0.0, 0.2}), {0.0, 0.0, 0.0});
  const RenderedView view = renderer.Render(T_world_camera);
  int mixed_colors = 0;
  for (int v = 0; v < view.bgr.rows; ++v) {
    for (int u = 0; u < view.bgr.cols; ++u) {
      const int blue = view.bgr.at<cv::Vec3b>(v, u)[0];
      mixed_colors += blue > 5 && blue < 235 ? 1 : 0;
      const float z = view.depth_m.at<float>(v, u);
      EXPECT_TRUE(z < 2.25F || z > 2.99F) << "mixed depth " << z << " at " << u << ", " << v;
    }
  }
  EXPECT_GT(mixed_colors, 60);
}

TEST(Renderer, GivesZeroDepthWhereThereIsNothing) {
  const Renderer renderer(MakeTestScene(), MakeSimulatedCamera(64, 48));
  const RenderedView view = renderer.Render(PoseAt({{0.0, 0.0, 1.0}, -1.57, 0.0}));
  EXPECT_EQ(cv::countNonZero(view.depth_m), 0);
  EXPECT_EQ(cv::countNonZero(view.instances), 0);
}

TEST(Renderer, PutsPointsWhereTheDistortedCameraProjectsThem) {
  Camera camera = MakeSimulatedCamera(320, 240);
  camera.k1 = 0.2;
  camera.k2 = -0.3;
  camera.p1 = 0.002;
  camera.p2 = -0.001;
  const Renderer renderer(MakeTestScene(), camera);
  const Se3 T_world_camera = PoseAt({{0.5, 0.0, 0.7}, 0.5 * std::numbers::pi, 0.0});
  const RenderedView view = renderer.Render(T_world_camera);
  // Just inside and outside of the box's upper left corner.
  const auto instance_at = [&](const Eigen::Vector3d& p_world) {
    const Eigen::Vector2d uv = Distort(camera, Project(camera, T_world_camera.Inverse() * p_world));
    return view.instances.at<std::uint16_t>(static_cast<int>(std::lround(uv.y())),
                                            static_cast<int>(std::lround(uv.x())));
  };
  EXPECT_EQ(instance_at({-0.19, 1.8, 1.19}), 1);
  EXPECT_EQ(instance_at({-0.21, 1.8, 1.19}), 0);
  EXPECT_EQ(instance_at({-0.19, 1.8, 1.21}), 0);
}

TEST(Renderer, GivesTheSameBytesTwice) {
  const Renderer first(MakeTestScene(), MakeSimulatedCamera(160, 120));
  const Renderer second(MakeTestScene(), MakeSimulatedCamera(160, 120));
  const RenderedView a = first.Render(ViewOfTheBox());
  const RenderedView b = second.Render(ViewOfTheBox());
  EXPECT_EQ(cv::norm(a.bgr, b.bgr, cv::NORM_L1), 0.0);
  EXPECT_EQ(cv::norm(a.depth_m, b.depth_m, cv::NORM_L1), 0.0);
  EXPECT_EQ(cv::norm(a.instances, b.instances, cv::NORM_L1), 0.0);
}

}  // namespace
}  // namespace cslam
