// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/room_tour.h"

#include <gtest/gtest.h>

#include <numbers>

namespace cslam {
namespace {

TEST(RingViews, GoesAroundWithTheGazeAheadOfTheWay) {
  RingWalk ring;
  ring.center_m = {1.0, 2.0};
  ring.radius_m = 0.5;
  ring.to_deg = 90.0;
  ring.lead_deg = 20.0;
  const std::vector<TimedView> views = RingViews(ring, 3.0, 12.0);
  EXPECT_DOUBLE_EQ(views.front().time_s, 3.0);
  EXPECT_DOUBLE_EQ(views.back().time_s, 12.0);
  EXPECT_NEAR(views.front().view.position.x(), 1.5, 1e-12);
  EXPECT_NEAR(views.back().view.position.y(), 2.5, 1e-12);
  EXPECT_NEAR(views.back().view.yaw_rad, 110.0 * std::numbers::pi / 180.0, 1e-12);
  ring.to_deg = -90.0;
  EXPECT_NEAR(RingViews(ring, 0.0, 1.0).back().view.yaw_rad, -110.0 * std::numbers::pi / 180.0,
              1e-12);
}

TEST(OneAfterTheOther, PlaysEachPartFromItsOwnStart) {
  const auto part = [](double x, double duration_s) {
    return CameraMotion{duration_s, [x](double time_s) {
                          return Se3(Eigen::Quaterniond::Identity(), {x, time_s, 0.0});
                        }};
  };
  const CameraMotion whole = OneAfterTheOther({part(1.0, 2.0), part(5.0, 3.0)});
  EXPECT_DOUBLE_EQ(whole.duration_s, 5.0);
  EXPECT_TRUE(whole.T_world_camera(1.5).translation.isApprox(Eigen::Vector3d(1.0, 1.5, 0.0)));
  EXPECT_TRUE(whole.T_world_camera(2.5).translation.isApprox(Eigen::Vector3d(5.0, 0.5, 0.0)));
  EXPECT_TRUE(whole.T_world_camera(9.0).translation.isApprox(Eigen::Vector3d(5.0, 7.0, 0.0)));
}

TEST(PiecewiseLinear, JoinsItsPointsAndIsLevelOutside) {
  const auto value = PiecewiseLinear({{1.0, 1.0}, {3.0, 0.0}});
  EXPECT_DOUBLE_EQ(value(0.0), 1.0);
  EXPECT_DOUBLE_EQ(value(2.0), 0.5);
  EXPECT_DOUBLE_EQ(value(7.0), 0.0);
}

}  // namespace
}  // namespace cslam
