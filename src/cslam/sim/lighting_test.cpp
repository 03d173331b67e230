// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/lighting.h"

#include "cslam/sim/scene_builder.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <algorithm>

namespace cslam {
namespace {

// A floor of 4 x 4 m under a lamp at 2 m, and a board 0.3 m above the middle of the floor.
Scene MakeLitScene() {
  SceneBuilder scene(1, 0.25);
  const int grey = scene.AddPicture(cv::Mat(4, 4, CV_8UC3, cv::Scalar::all(128)));
  scene.AddObject("floor", kNoClass, Se3(), [&](MeshBuilder& mesh) {
    mesh.AddRectangle({-2.0, 2.0, 0.0}, {4.0, 0.0, 0.0}, {0.0, -4.0, 0.0}, grey);
  });
  scene.AddBox("board", kNoClass, Standing(0.0, 0.0, 0.3), {1.0, 1.0, 0.05}, Uniform(grey));
  Lighting lighting;
  lighting.lights.push_back({{-0.5, -0.5, 2.0}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, 5.0});
  lighting.ambient = 0.1;
  return scene.Take(lighting);
}

float GainNear(const Scene& scene, const VertexGains& gains, std::size_t object,
               const Eigen::Vector3f& p) {
  const std::vector<Eigen::Vector3f>& positions = scene.objects[object].mesh.positions;
  const auto nearest = std::ranges::min_element(
      positions, {}, [&](const Eigen::Vector3f& q) { return (q - p).squaredNorm(); });
  return gains[object][static_cast<std::size_t>(nearest - positions.begin())];
}

TEST(BakeLighting, DarkensTheFloorUnderABoardAndFarFromTheLamp) {
  const Scene scene = MakeLitScene();
  const VertexGains gains = BakeLighting(scene, RayScene(scene));
  ASSERT_EQ(gains.size(), 2U);
  const float under = GainNear(scene, gains, 0, {0.0F, 0.0F, 0.0F});
  const float beside = GainNear(scene, gains, 0, {0.0F, 1.5F, 0.0F});
  const float corner = GainNear(scene, gains, 0, {1.9F, 1.9F, 0.0F});
  EXPECT_LT(under, 0.8F * beside);
  EXPECT_LT(corner, 0.95F * beside);
  EXPECT_GT(corner, under) << under;
}

TEST(BakeLighting, LightsTheSideThatFacesTheLamp) {
  const Scene scene = MakeLitScene();
  const VertexGains gains = BakeLighting(scene, RayScene(scene));
  const Mesh& board = scene.objects[1].mesh;
  float brightest_top = 0.0F;
  float brightest_bottom = 0.0F;
  for (std::size_t v = 0; v < board.normals.size(); ++v) {
    if (board.normals[v].z() > 0.9F) brightest_top = std::max(brightest_top, gains[1][v]);
    if (board.normals[v].z() < -0.9F) brightest_bottom = std::max(brightest_bottom, gains[1][v]);
  }
  EXPECT_GT(brightest_top, 1.2F * brightest_bottom);
}

TEST(BakeLighting, LeavesNoBlackSpotUnderThingsThatStandOnTheFloor) {
  SceneBuilder builder(1, 0.1);
  const int grey = builder.AddPicture(cv::Mat(4, 4, CV_8UC3, cv::Scalar::all(128)));
  builder.AddObject("floor", kNoClass, Se3(), [&](MeshBuilder& mesh) {
    mesh.AddRectangle({-1.0, 1.0, 0.0}, {2.0, 0.0, 0.0}, {0.0, -2.0, 0.0}, grey);
  });
  // Sunk a little, as boxes that stand on something uneven are.
  builder.AddBox("box", kNoClass, Standing(0.0, 0.0, -0.02), {0.3, 0.3, 0.3}, Uniform(grey));
  const Scene scene = builder.Take(Lighting{});
  const VertexGains gains = BakeLighting(scene, RayScene(scene));
  const float open = GainNear(scene, gains, 0, {0.9F, 0.9F, 0.0F});
  EXPECT_GT(GainNear(scene, gains, 0, {0.1F, 0.1F, 0.0F}), 0.4F * open);
}

TEST(BakeLighting, GivesTheSameLightTwice) {
  const Scene scene = MakeLitScene();
  EXPECT_EQ(BakeLighting(scene, RayScene(scene)), BakeLighting(scene, RayScene(scene)));
}

}  // namespace
}  // namespace cslam
