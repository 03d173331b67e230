// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/procedural_props.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <algorithm>
#include <set>

namespace cslam {
namespace {

constexpr double kTexelsPerM = 60.0;  // coarse, so that painting takes no time

Scene SceneWith(PropKind kind, int variant) {
  const ProceduralProps props(kTexelsPerM);
  SceneBuilder builder(1, 0.12);
  EXPECT_EQ(props.Add(builder, kind, variant, "it", Se3()), 0);
  return builder.Take(Lighting{});
}

class EveryPropKind : public testing::TestWithParam<int> {
 protected:
  PropKind kind() const { return static_cast<PropKind>(GetParam()); }
};

TEST_P(EveryPropKind, FillsItsBoxAndStandsOnTheGround) {
  const Eigen::Vector3f size_m = StandardSizeM(kind()).cast<float>();
  for (const int variant : {0, 1, 7, -3}) {
    const Scene scene = SceneWith(kind(), variant);
    CheckScene(scene);
    Eigen::AlignedBox3f bounds;
    for (const Eigen::Vector3f& p : scene.objects[0].mesh.positions)
      bounds.extend(p);
    constexpr float kSlackM = 0.002F;
    EXPECT_NEAR(bounds.min().z(), 0.0F, 0.02F) << NameOf(kind());
    for (int axis = 0; axis < 3; ++axis) {
      const float low = axis == 2 ? 0.0F : -0.5F * size_m[axis];
      EXPECT_GE(bounds.min()[axis], low - kSlackM) << NameOf(kind()) << " axis " << axis;
      EXPECT_LE(bounds.max()[axis], low + size_m[axis] + kSlackM) << NameOf(kind()) << axis;
      EXPECT_GE(bounds.sizes()[axis], 0.75F * size_m[axis]) << NameOf(kind()) << " axis " << axis;
    }
  }
}

TEST_P(EveryPropKind, HasUnitNormalsThatAgreeWithItsTriangles) {
  const Scene scene = SceneWith(kind(), 0);
  const Mesh& mesh = scene.objects[0].mesh;
  EXPECT_EQ(scene.objects[0].class_id, CocoClassOf(kind()));
  ASSERT_FALSE(mesh.triangles.empty());
  EXPECT_LT(mesh.triangles.size(), 60000U);
  std::size_t num_against = 0;
  for (const Triangle& t : mesh.triangles) {
    const Eigen::Vector3f& a = mesh.positions[t.vertices[0]];
    const Eigen::Vector3f cross = (mesh.positions[t.vertices[1]] - a)
                                      .cross(Eigen::Vector3f(mesh.positions[t.vertices[2]] - a));
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (const std::uint32_t v : t.vertices)
      sum += mesh.normals[v];
    num_against += cross.dot(sum) <= 0.0F ? 1U : 0U;
  }
  EXPECT_EQ(num_against, 0U) << NameOf(kind());
  for (const Eigen::Vector3f& n : mesh.normals)
    EXPECT_NEAR(n.norm(), 1.0F, 1e-4F);
}

// The divergence theorem: a closed surface that points outwards encloses a positive volume.
TEST_P(EveryPropKind, PointsOutwards) {
  const Mesh mesh = SceneWith(kind(), 0).objects[0].mesh;
  double volume_m3 = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.positions[t.vertices[0]].cast<double>();
    const Eigen::Vector3d b = mesh.positions[t.vertices[1]].cast<double>();
    const Eigen::Vector3d c = mesh.positions[t.vertices[2]].cast<double>();
    volume_m3 += a.dot(b.cross(c)) / 6.0;
  }
  EXPECT_GT(volume_m3, 0.0) << NameOf(kind());
}

TEST_P(EveryPropKind, IsTheSameWheneverItIsMade) {
  const Scene a = SceneWith(kind(), 2);
  const Scene b = SceneWith(kind(), 2);
  EXPECT_EQ(a.objects[0].mesh.positions, b.objects[0].mesh.positions);
  EXPECT_EQ(a.objects[0].mesh.uvs, b.objects[0].mesh.uvs);
  EXPECT_EQ(a.textures.size(), b.textures.size());
}

INSTANTIATE_TEST_SUITE_P(ProceduralProps, EveryPropKind, testing::Range(0, kNumPropKinds),
                         [](const auto& param_info) {
                           return std::string(NameOf(static_cast<PropKind>(param_info.param)));
                         });

TEST(PropLibrary, NamesAreDistinctAndClassesAreCocos) {
  std::set<std::string_view> names;
  for (int i = 0; i < kNumPropKinds; ++i) {
    const auto kind = static_cast<PropKind>(i);
    EXPECT_TRUE(names.insert(NameOf(kind)).second) << NameOf(kind);
    EXPECT_LT(CocoClassOf(kind), 80);
    EXPECT_LE(StandardTopM(kind), StandardSizeM(kind).z());
  }
  EXPECT_EQ(CocoClassOf(PropKind::kTeddyBear), 77);
  EXPECT_EQ(CocoClassOf(PropKind::kCarton), kNoClass);
}

TEST(ProceduralProps, AddSurfaceGivesAllButRugsAPeriod) {
  const ProceduralProps props(kTexelsPerM);
  SceneBuilder builder(1, 0.12);
  constexpr int kNumSurfaces = static_cast<int>(SurfaceKind::kWood) + 1;
  for (int i = 0; i < kNumSurfaces; ++i)
    EXPECT_EQ(props.AddSurface(builder, static_cast<SurfaceKind>(i), i), i);
  const Scene scene = builder.Take(Lighting{});
  for (int i = 0; i < kNumSurfaces; ++i) {
    const Eigen::Vector2d period_m = scene.materials[static_cast<std::size_t>(i)].period_m;
    if (static_cast<SurfaceKind>(i) == SurfaceKind::kRug) {
      EXPECT_TRUE(period_m.isZero());
    } else {
      EXPECT_GT(period_m.minCoeff(), 0.5);
    }
  }
}

TEST(ProceduralProps, PosterDiffersByVariant) {
  const ProceduralProps props(kTexelsPerM);
  const cv::Mat a = props.Poster(1);
  const cv::Mat b = props.Poster(2);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_GT(cv::norm(a, b, cv::NORM_L1), 0.0);
  EXPECT_EQ(cv::norm(a, props.Poster(1), cv::NORM_L1), 0.0);
}

}  // namespace
}  // namespace cslam
