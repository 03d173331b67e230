// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// The renderer on a world in which things come, go and move.
#include "cslam/sim/camera_path.h"
#include "cslam/sim/renderer.h"
#include "cslam/sim/simulated_sequence.h"
#include "cslam/sim/test_world.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <cmath>
#include <numbers>
#include <thread>

namespace cslam {
namespace {

using test::kBody;
using test::kBox;
using test::kTable;
using test::MakeTestWorld;

const Camera kCamera = MakeSimulatedCamera(160, 120);

Se3 FrontView() {
  return PoseAt({{0.0, -2.5, 1.0}, 0.5 * std::numbers::pi, -0.2});
}

int PixelsOf(const RenderedView& view, int instance) {
  return cv::countNonZero(view.instances == instance);
}

std::uint16_t InstanceAt(const RenderedView& view, const Se3& T_world_camera,
                         const Eigen::Vector3d& p_world) {
  const Eigen::Vector2d uv = Project(kCamera, T_world_camera.Inverse() * p_world);
  return view.instances.at<std::uint16_t>(static_cast<int>(std::lround(uv.y())),
                                          static_cast<int>(std::lround(uv.x())));
}

void ExpectSame(const RenderedView& a, const RenderedView& b) {
  EXPECT_EQ(cv::norm(a.bgr, b.bgr, cv::NORM_L1), 0.0);
  EXPECT_EQ(cv::norm(a.depth_m, b.depth_m, cv::NORM_L1), 0.0);
  EXPECT_EQ(cv::norm(a.instances, b.instances, cv::NORM_L1), 0.0);
  ASSERT_EQ(a.velocity_m_s.empty(), b.velocity_m_s.empty());
  if (!a.velocity_m_s.empty()) {
    EXPECT_EQ(cv::norm(a.velocity_m_s, b.velocity_m_s, cv::NORM_L1), 0.0);
  }
}

TEST(WorldRenderer, ShowsThingsWhileTheyAreThere) {
  const Renderer renderer(MakeTestWorld(), kCamera);
  EXPECT_GT(PixelsOf(renderer.Render(FrontView(), 5.999), kBox), 100);
  EXPECT_EQ(PixelsOf(renderer.Render(FrontView(), 6.0), kBox), 0);
  EXPECT_EQ(PixelsOf(renderer.Render(FrontView(), 0.999), kBody), 0);
  EXPECT_GT(PixelsOf(renderer.Render(FrontView(), 2.0), kBody), 500);
  EXPECT_EQ(PixelsOf(renderer.Render(FrontView(), 5.0), kBody), 0);
}

TEST(WorldRenderer, CarriesThingsAlongTheirTimeline) {
  const Renderer renderer(MakeTestWorld(), kCamera);
  const Se3 view_pose = PoseAt({{0.0, -2.5, 2.0}, 0.5 * std::numbers::pi, -0.5});
  for (const double time_s : {1.0, 2.4, 2.8, 3.6, 4.5}) {
    const RenderedView view = renderer.Render(view_pose, time_s);
    const double x = std::clamp(time_s - 3.0, -1.0, 1.0);
    EXPECT_EQ(InstanceAt(view, view_pose, {x, 0.3, 0.35}), kBox) << time_s;
    EXPECT_EQ(InstanceAt(view, view_pose, {x - 0.17, 0.3, 0.35}), kBox) << time_s;
    EXPECT_NE(InstanceAt(view, view_pose, {x + std::copysign(0.24, x), 0.3, 0.35}), kBox) << time_s;
  }
}

TEST(WorldRenderer, LetsBodiesHideWhatIsBehindThemAndTheOtherWayRound) {
  const Renderer renderer(MakeTestWorld(), kCamera);
  const RenderedView view = renderer.Render(FrontView(), 3.0);
  EXPECT_EQ(InstanceAt(view, FrontView(), {0.0, -0.65, 1.0}), kBody);
  EXPECT_NEAR(view.depth_m.at<float>(40, 80), 2.0F, 0.3F);
  // From behind the table, the body's feet are hidden.
  const Se3 behind = PoseAt({{0.0, 2.9, 0.5}, -0.5 * std::numbers::pi, 0.0});
  const RenderedView back = renderer.Render(behind, 3.0);
  EXPECT_EQ(InstanceAt(back, behind, {0.0, 1.9, 0.4}), kTable);
  EXPECT_EQ(InstanceAt(back, behind, {0.0, -0.35, 1.2}), kBody);
}

TEST(WorldRenderer, MeasuresHowFastThingsMove) {
  const Renderer renderer(MakeTestWorld(), kCamera);
  EXPECT_TRUE(renderer.Render(FrontView(), 0.5).velocity_m_s.empty());
  const RenderedView view = renderer.Render(FrontView(), 2.4);
  for (const int instance : {0, kBox, kBody}) {
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(view.velocity_m_s, mean, deviation, view.instances == instance);
    const double speed_m_s = instance == 0 ? 0.0 : instance == kBox ? 1.0 : -1.0;
    EXPECT_NEAR(mean[0], speed_m_s, 1e-3) << instance;
    EXPECT_NEAR(mean[1], 0.0, 1e-3) << instance;
    EXPECT_NEAR(deviation[0], 0.0, 1e-3) << instance;
  }
}

TEST(WorldRenderer, DarkensTheFloorNearFeet) {
  const Renderer renderer(MakeTestWorld(), kCamera);
  const Se3 view_pose = PoseAt({{0.0, -2.5, 2.0}, 0.5 * std::numbers::pi, -0.6});
  const auto brightness = [&](double time_s, const Eigen::Vector3d& p) {
    const Eigen::Vector2d uv = Project(kCamera, view_pose.Inverse() * p);
    return int{renderer.Render(view_pose, time_s)
                   .bgr.at<cv::Vec3b>(static_cast<int>(std::lround(uv.y())),
                                      static_cast<int>(std::lround(uv.x())))[1]};
  };
  const Eigen::Vector3d beside_feet(0.0, -0.72, 0.0);
  EXPECT_LT(brightness(3.0, beside_feet), brightness(0.5, beside_feet) - 10);
  const Eigen::Vector3d far_off(1.5, -0.72, 0.0);
  EXPECT_EQ(brightness(3.0, far_off), brightness(2.5, far_off));
}

TEST(WorldRenderer, GivesTheSameBytesInAnyOrderAndFromAnyThread) {
  const std::vector<double> times_s{0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 7.0};
  std::vector<RenderedView> alone;
  for (const double time_s : times_s)
    alone.push_back(Renderer(MakeTestWorld(), kCamera).Render(FrontView(), time_s));
  const Renderer shared(MakeTestWorld(), kCamera);
  std::vector<RenderedView> forwards(times_s.size());
  std::vector<RenderedView> backwards(times_s.size());
  {
    const std::jthread other([&] {
      for (std::size_t i = 0; i < times_s.size(); ++i)
        forwards[i] = shared.Render(FrontView(), times_s[i]);
    });
    for (std::size_t i = times_s.size(); i-- > 0;)
      backwards[i] = shared.Render(FrontView(), times_s[i]);
  }
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    ExpectSame(alone[i], forwards[i]);
    ExpectSame(alone[i], backwards[i]);
  }
}

}  // namespace
}  // namespace cslam
