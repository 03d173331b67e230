// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/scene.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>

namespace cslam {
namespace {

// A long thin strip of two triangles, 2 m by 0.02 m.
Mesh MakeStrip() {
  Mesh mesh;
  mesh.positions = {
      {0.0F, 0.0F, 0.0F}, {2.0F, 0.0F, 0.0F}, {2.0F, 0.02F, 0.0F}, {0.0F, 0.02F, 0.0F}};
  mesh.normals.assign(4, Eigen::Vector3f::UnitZ());
  mesh.uvs = {{0.0F, 0.0F}, {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}};
  mesh.triangles = {{{0, 1, 2}, 0}, {{0, 2, 3}, 0}};
  return mesh;
}

float AreaOf(const Mesh& mesh) {
  float area = 0.0F;
  for (const Triangle& t : mesh.triangles) {
    const Eigen::Vector3f& a = mesh.positions[t.vertices[0]];
    area += 0.5F * (mesh.positions[t.vertices[1]] - a).cross(mesh.positions[t.vertices[2]] - a).z();
  }
  return area;
}

TEST(SubdivideLongEdges, CutsLongEdgesAndKeepsTheShape) {
  const Mesh mesh = SubdivideLongEdges(MakeStrip(), 0.1);
  EXPECT_NEAR(AreaOf(mesh), 0.04F, 1e-5F);
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const float length_m =
          (mesh.positions[t.vertices[i]] - mesh.positions[t.vertices[(i + 1) % 3]]).norm();
      EXPECT_LE(length_m, 0.1001F);
    }
  }
  EXPECT_LT(mesh.triangles.size(), 600U) << "the short edges need no cut";
}

TEST(SubdivideLongEdges, SharesNewVerticesBetweenNeighbours) {
  const Mesh mesh = SubdivideLongEdges(MakeStrip(), 0.1);
  const auto twice = [&](std::size_t v) {
    return std::ranges::count(mesh.positions, mesh.positions[v]) > 1;
  };
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    EXPECT_FALSE(twice(v)) << v;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    EXPECT_NEAR(mesh.uvs[v].x(), 0.5F * mesh.positions[v].x(), 1e-5F);
}

TEST(SubdivideLongEdges, LeavesShortEdgesAlone) {
  const Mesh mesh = SubdivideLongEdges(MakeStrip(), 3.0);
  EXPECT_EQ(mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh.positions.size(), 4U);
}

}  // namespace
}  // namespace cslam
