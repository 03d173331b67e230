// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/scene.h"

#include "cslam/sim/test_scene.h"
#include "cslam/util/check.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace cslam {
namespace {

std::vector<Material> OneMaterial(double period_m) {
  return {Material{.texture = 0, .period_m = {period_m, period_m}}};
}

Eigen::Vector3f FaceNormal(const Mesh& mesh, const Triangle& triangle) {
  const auto [a, b, c] = triangle.vertices;
  return (mesh.positions[b] - mesh.positions[a])
      .cross(mesh.positions[c] - mesh.positions[a])
      .normalized();
}

TEST(MeshBuilder, TurnsEveryFaceOfABoxOutwards) {
  const std::vector<Material> materials = OneMaterial(0.0);
  MeshBuilder builder(materials, 10.0, Rng(1));
  builder.AddBox(Se3(), {1.0, 2.0, 3.0}, Uniform(0));
  const Mesh mesh = builder.Take();
  ASSERT_EQ(mesh.triangles.size(), 12U);
  const Eigen::Vector3f centre(0.0F, 0.0F, 1.5F);
  for (const Triangle& triangle : mesh.triangles) {
    const Eigen::Vector3f& corner = mesh.positions[triangle.vertices[0]];
    EXPECT_GT(mesh.normals[triangle.vertices[0]].dot(corner - centre), 0.4F);
    EXPECT_NEAR(FaceNormal(mesh, triangle).dot(mesh.normals[triangle.vertices[0]]), 1.0F, 1e-5F);
  }
}

TEST(MeshBuilder, LeavesOutFacesWithoutMaterial) {
  const std::vector<Material> materials = OneMaterial(0.0);
  MeshBuilder builder(materials, 10.0, Rng(1));
  builder.AddBox(Se3(), {1.0, 1.0, 1.0}, {0, -1, -1, -1, 0, -1});
  EXPECT_EQ(builder.Take().triangles.size(), 4U);
}

TEST(MeshBuilder, CutsFacesNoCoarserThanTheCell) {
  const std::vector<Material> materials = OneMaterial(0.0);
  MeshBuilder builder(materials, 0.25, Rng(1));
  builder.AddRectangle({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, -0.6}, 0);
  const Mesh mesh = builder.Take();
  EXPECT_EQ(mesh.positions.size(), 5U * 4U);
  EXPECT_EQ(mesh.triangles.size(), 2U * 4U * 3U);
}

TEST(MeshBuilder, StretchesPicturesAndRepeatsSurfaces) {
  const std::vector<Material> fit = OneMaterial(0.0);
  MeshBuilder pictures(fit, 10.0, Rng(1));
  pictures.AddRectangle({0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 0);
  const Mesh picture = pictures.Take();
  EXPECT_TRUE(picture.uvs.front().isApprox(Eigen::Vector2f(0.0F, 0.0F)));
  EXPECT_TRUE(picture.uvs.back().isApprox(Eigen::Vector2f(1.0F, 1.0F)));

  const std::vector<Material> metric = OneMaterial(0.5);
  MeshBuilder surfaces(metric, 10.0, Rng(1));
  surfaces.AddRectangle({0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 0);
  const Mesh surface = surfaces.Take();
  EXPECT_TRUE((surface.uvs.back() - surface.uvs.front()).isApprox(Eigen::Vector2f(4.0F, 2.0F)));
}

TEST(CheckScene, NamesTheObjectThatPointsNowhere) {
  Scene scene = MakeTestScene();
  EXPECT_NO_THROW(CheckScene(scene));
  scene.objects[1].mesh.triangles[0].vertices[0] = 9999;
  try {
    CheckScene(scene);
    FAIL() << "nothing thrown";
  } catch (const InternalError& error) {
    EXPECT_NE(std::string(error.what()).find("box"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace cslam
