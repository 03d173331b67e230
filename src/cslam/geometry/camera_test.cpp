// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/geometry/camera.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace cslam {
namespace {

Camera PlainCamera() {
  return {.width = 640, .height = 480, .fx = 525.0, .fy = 520.0, .cx = 319.5, .cy = 239.5};
}

// Published calibrations of the TUM RGB-D cameras and the Bonn one: mild and strong lenses.
std::vector<Camera> RealCameras() {
  return {
      {640, 480, 517.306408, 516.469215, 318.643040, 255.313989, 0.262383, -0.953104, -0.005358,
       0.002628, 1.163314},
      {640, 480, 520.908620, 521.007327, 325.141442, 249.701764, 0.231222, -0.784899, -0.003257,
       -0.000105, 0.917205},
      {640, 480, 542.822841, 542.576870, 315.593520, 237.756098, 0.039903, -0.099343, -0.000730,
       -0.000144, 0.0},
  };
}

TEST(Project, UndoesUnproject) {
  const Camera camera = PlainCamera();
  for (double u = 0.0; u < camera.width; u += 80.0) {
    for (double v = 0.0; v < camera.height; v += 60.0) {
      const Eigen::Vector3d p = Unproject(camera, {u, v}, 2.5);
      EXPECT_DOUBLE_EQ(p.z(), 2.5);
      EXPECT_LT((Project(camera, p) - Eigen::Vector2d(u, v)).norm(), 1e-10);
    }
  }
}

TEST(Project, PutsTheAxisAtThePrincipalPointAndXToTheRight) {
  const Camera camera = PlainCamera();
  EXPECT_EQ(Project(camera, {0.0, 0.0, 3.0}), Eigen::Vector2d(camera.cx, camera.cy));
  EXPECT_DOUBLE_EQ(Project(camera, {1.0, 0.0, 2.0}).x(), camera.cx + camera.fx / 2.0);
  EXPECT_DOUBLE_EQ(Project(camera, {0.0, 1.0, 2.0}).y(), camera.cy + camera.fy / 2.0);
}

TEST(Undistort, UndoesDistortEverywhereInTheImage) {
  for (const Camera& camera : RealCameras()) {
    for (double u = 0.0; u <= camera.width; u += 16.0) {
      for (double v = 0.0; v <= camera.height; v += 16.0) {
        const Eigen::Vector2d raw(u, v);
        EXPECT_LT((Distort(camera, Undistort(camera, raw)) - raw).norm(), 1e-6)
            << "fx " << camera.fx << " at " << u << " " << v;
      }
    }
  }
}

TEST(Distort, FollowsTheModelAtAHandComputedPoint) {
  Camera camera = PlainCamera();
  camera.k1 = 0.1;
  camera.k2 = 0.2;
  camera.p1 = 0.01;
  camera.p2 = 0.02;
  camera.k3 = 0.3;
  // x = 0.5, y = 0: r2 = 0.25, radial = 1 + 0.025 + 0.0125 + 0.0046875.
  const Eigen::Vector2d ideal(camera.cx + 0.5 * camera.fx, camera.cy);
  const Eigen::Vector2d raw = Distort(camera, ideal);
  EXPECT_NEAR((raw.x() - camera.cx) / camera.fx, 0.5 * 1.0421875 + 0.02 * 0.75, 1e-12);
  EXPECT_NEAR((raw.y() - camera.cy) / camera.fy, 0.01 * 0.25, 1e-12);
}

TEST(Distort, IsExactlyTheIdentityWithoutDistortion) {
  const Eigen::Vector2d px(123.25, 67.5);
  EXPECT_EQ(Distort(PlainCamera(), px), px);
  EXPECT_EQ(Undistort(PlainCamera(), px), px);
  EXPECT_FALSE(PlainCamera().HasDistortion());
}

TEST(Undistort, StaysFiniteBeyondTheFoldOfTheModel) {
  Camera camera = PlainCamera();
  camera.k1 = -0.8;  // folds back inside the image
  for (double u = 0.0; u <= camera.width; u += 16.0) {
    EXPECT_TRUE(Undistort(camera, {u, 0.0}).allFinite()) << u;
  }
}

TEST(UndistortedBounds, HoldEveryUndistortedPixel) {
  for (const Camera& camera : RealCameras()) {
    const ImageBounds bounds = UndistortedBounds(camera);
    for (int u = 1; u < camera.width; u += 13) {
      for (int v = 1; v < camera.height; v += 13) {
        EXPECT_TRUE(bounds.Contains(Undistort(camera, Eigen::Vector2d(u, v)))) << u << " " << v;
      }
    }
  }
}

TEST(UndistortedBounds, AreTheImageWithoutDistortion) {
  const ImageBounds bounds = UndistortedBounds(PlainCamera());
  EXPECT_EQ(bounds.min_u, 0.0);
  EXPECT_EQ(bounds.max_u, 640.0);
  EXPECT_EQ(bounds.min_v, 0.0);
  EXPECT_EQ(bounds.max_v, 480.0);
  EXPECT_TRUE(bounds.Contains({0.0, 0.0}));
  EXPECT_FALSE(bounds.Contains({640.0, 10.0}));
}

TEST(WhyInvalid, IsEmptyWhenTheCameraCanBeUsed) {
  EXPECT_EQ(WhyInvalid(PlainCamera()), "");
  for (const Camera& camera : RealCameras())
    EXPECT_EQ(WhyInvalid(camera), "");
}

TEST(WhyInvalid, NamesWhatIsWrong) {
  const auto why = [](auto change) {
    Camera camera = PlainCamera();
    change(camera);
    return WhyInvalid(camera);
  };
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(has(why([&](Camera& c) { c.fx = nan; }), "not a finite number"));
  EXPECT_TRUE(has(why([&](Camera& c) { c.k3 = std::numeric_limits<double>::infinity(); }),
                  "not a finite number"));
  EXPECT_TRUE(has(why([](Camera& c) { c.fy = 0.0; }), "focal lengths"));
  EXPECT_TRUE(has(why([](Camera& c) { c.fx = -525.0; }), "focal lengths"));
  EXPECT_TRUE(has(why([](Camera& c) { c.width = 0; }), "image size"));
  EXPECT_TRUE(has(why([](Camera& c) { c.cx = 700.0; }), "principal point"));
}

}  // namespace
}  // namespace cslam
