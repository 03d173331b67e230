// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/mapping/object_geometry.h"

#include "cslam/mapping/test_objects.h"

#include <gtest/gtest.h>

#include <numbers>

namespace cslam {
namespace {

using Points = std::vector<Eigen::Vector3f>;

const Eigen::Vector3d kUp = -Eigen::Vector3d::UnitY();

// Random points on the six sides of a box about the origin, turned about the vertical.
Points PointsOfBox(const Eigen::Vector3d& size, double angle_rad, int count = 3000) {
  Rng rng(5);
  const Se3 turned(ExpSo3({0.0, angle_rad, 0.0}), Eigen::Vector3d::Zero());
  Points points;
  for (int i = 0; i < count; ++i) {
    Eigen::Vector3d p;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = rng.Uniform(-0.5, 0.5);
    p[i % 3] = i % 2 == 0 ? -0.5 : 0.5;
    points.push_back((turned * p.cwiseProduct(size)).cast<float>());
  }
  return points;
}

// A surface as one view would leave it, each cell seen so often.
ObjectSurface SurfaceOf(const Points& points, int views) {
  ObjectSurface surface;
  for (int i = 0; i < views; ++i)
    surface = WithView(surface, points, Se3(), DepthView{}, DepthRegion{}, 0.02);
  return surface;
}

// A panel of 0.4 x 0.4 m at 2 m before a wall at 3 m; the region also holds 5 columns of the wall.
struct PanelView {
  DepthView view{cv::Mat(120, 160, CV_16UC1, cv::Scalar(3000)), 4, test::RoomCamera()};
  DepthRegion panel;
  DepthRegion with_wall;

  PanelView() {
    view.depth_mm(cv::Rect(67, 47, 26, 26)).setTo(2000);
    cv::Mat mask = cv::Mat::zeros(view.depth_mm.size(), CV_8UC1);
    mask(cv::Rect(67, 47, 26, 26)).setTo(255);
    panel = test::RegionOf(view, mask.clone());
    mask(cv::Rect(93, 47, 5, 26)).setTo(255);
    with_wall = test::RegionOf(view, mask);
  }
};

TEST(PointsOfRegion, AreTheReadingsInside) {
  const PanelView seen;
  const Points points = PointsOfRegion(seen.view, seen.panel, 10'000);
  EXPECT_EQ(points.size(), 26U * 26U - 4U) << "corners have few neighbours";
  for (const Eigen::Vector3f& p : points) {
    EXPECT_FLOAT_EQ(p.z(), 2.0F);
    EXPECT_LT(std::abs(p.x()), 0.22F);
  }
  EXPECT_EQ(PointsOfRegion(seen.view, seen.panel, 100).size(), 100U);
}

TEST(PointsOfRegion, LeavesOutMissingAndFlyingReadings) {
  PanelView seen;
  seen.view.depth_mm(cv::Rect(67, 47, 26, 13)).setTo(0);
  seen.view.depth_mm.at<std::uint16_t>(66, 80) = 2500;  // between panel and wall
  const Points points = PointsOfRegion(seen.view, seen.panel, 10'000);
  EXPECT_LE(points.size(), 26U * 13U - 1U);
  EXPECT_GE(points.size(), 26U * 13U - 30U);
  for (const Eigen::Vector3f& p : points)
    EXPECT_FLOAT_EQ(p.z(), 2.0F);
  seen.view.depth_mm.setTo(0);
  EXPECT_TRUE(PointsOfRegion(seen.view, seen.panel, 100).empty());
}

TEST(WithView, CountsEachCellOncePerView) {
  const Points points = PointsOfBox({0.5, 0.8, 0.5}, 0.0);
  const ObjectSurface once = SurfaceOf(points, 1);
  const ObjectSurface thrice = SurfaceOf(points, 3);
  ASSERT_EQ(once.voxels.size(), thrice.voxels.size());
  for (std::size_t i = 0; i < once.voxels.size(); ++i) {
    EXPECT_EQ(once.voxels[i].num_inside, 1);
    EXPECT_EQ(thrice.voxels[i].num_inside, 3);
  }
  EXPECT_TRUE(std::is_sorted(once.voxels.begin(), once.voxels.end(),
                             [](const auto& a, const auto& b) { return a.cell < b.cell; }));
}

TEST(WithView, KeepsFewSamplesAllOverTheSurface) {
  const ObjectSurface surface = SurfaceOf(PointsOfBox({0.5, 0.8, 0.5}, 0.0), 1);
  EXPECT_GT(surface.voxels.size(), 500U);
  EXPECT_LE(surface.samples.size(), 96U);
  float left = 0.0F;
  float right = 0.0F;
  for (const Eigen::Vector3f& sample : surface.samples) {
    left = std::min(left, sample.x());
    right = std::max(right, sample.x());
  }
  EXPECT_LT(left, -0.2F);
  EXPECT_GT(right, 0.2F);
}

TEST(WithView, ForgetsTheWallThatOneRegionHadRunInto) {
  const PanelView seen;
  ObjectSurface surface;
  surface = WithView(surface, PointsOfRegion(seen.view, seen.with_wall, 2000), Se3(), seen.view,
                     seen.with_wall, 0.02);
  const auto has_wall = [&] {
    const Points trusted = TrustedPoints(surface);
    return std::any_of(trusted.begin(), trusted.end(),
                       [](const Eigen::Vector3f& p) { return p.z() > 2.5F; });
  };
  EXPECT_TRUE(has_wall());
  for (int i = 0; i < 4; ++i) {
    surface = WithView(surface, PointsOfRegion(seen.view, seen.panel, 2000), Se3(), seen.view,
                       seen.panel, 0.02);
  }
  EXPECT_FALSE(has_wall());
  EXPECT_TRUE(std::none_of(surface.voxels.begin(), surface.voxels.end(),
                           [](const SurfaceVoxel& v) { return v.p.z() > 2.5F; }));
}

TEST(WithView, TakesViewsFromElsewhereIntoTheSurfacesFrame) {
  const Points points{{0.0F, 0.0F, 2.0F}};
  const Se3 aside(Eigen::Quaterniond::Identity(), Eigen::Vector3d(1.0, 0.0, 0.0));
  const ObjectSurface surface =
      WithView(ObjectSurface{}, points, aside, DepthView{}, DepthRegion{}, 0.02);
  ASSERT_EQ(surface.voxels.size(), 1U);
  EXPECT_LT((surface.voxels[0].p - Eigen::Vector3f(1.0F, 0.0F, 2.0F)).norm(), 1e-5F);
}

TEST(WithView, StaysBoundedWhenReadingsAreEverywhere) {
  Rng rng(8);
  ObjectSurface surface;
  for (int i = 0; i < 30; ++i) {
    Points points;
    for (int k = 0; k < 300; ++k) {
      const Eigen::Vector3d p(rng.Uniform(-3.0, 3.0), rng.Uniform(-3.0, 3.0),
                              rng.Uniform(1.0, 6.0));
      points.push_back(p.cast<float>());
    }
    surface = WithView(surface, points, Se3(), DepthView{}, DepthRegion{}, 0.02);
  }
  EXPECT_LE(surface.voxels.size(), 4300U);
}

TEST(Joined, HasTheCellsOfBothInOneFrame) {
  const ObjectSurface surface = SurfaceOf({{0.0F, 0.0F, 0.0F}, {0.5F, 0.0F, 0.0F}}, 1);
  const ObjectSurface other = SurfaceOf({{0.0F, 0.0F, 0.0F}, {0.9F, 0.0F, 0.0F}}, 2);
  const Se3 aside(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.5, 0.0, 0.0));
  const ObjectSurface joined = Joined(surface, other, aside);
  ASSERT_EQ(joined.voxels.size(), 3U);
  EXPECT_EQ(joined.voxels[0].num_inside, 1);
  EXPECT_EQ(joined.voxels[1].num_inside, 3) << "seen by both";
  EXPECT_NEAR(joined.voxels[2].p.x(), 1.4F, 1e-5F);
}

TEST(TrustedPoints, LeaveOutWhatWasSeenOnceAmongMany) {
  ObjectSurface surface = SurfaceOf(PointsOfBox({0.3, 0.3, 0.3}, 0.0), 30);
  const std::size_t count = TrustedPoints(surface).size();
  surface = WithView(surface, Points{{2.0F, 0.0F, 0.0F}}, Se3(), DepthView{}, DepthRegion{}, 0.02);
  EXPECT_EQ(TrustedPoints(surface).size(), count);
  EXPECT_TRUE(TrustedPoints(ObjectSurface{}).empty());
}

TEST(Overlap, IsTheShareOfPointsOnTheSurface) {
  const Points box = PointsOfBox({0.5, 0.5, 0.5}, 0.0);
  const ObjectSurface surface = SurfaceOf(box, 1);
  EXPECT_DOUBLE_EQ(Overlap(surface, box, 0.045), 1.0);
  Points half = box;
  for (std::size_t i = 0; i < half.size(); i += 2)
    half[i].x() += 2.0F;
  EXPECT_NEAR(Overlap(surface, half, 0.045), 0.5, 0.01);
  EXPECT_DOUBLE_EQ(Overlap(surface, {}, 0.045), 0.0);
  EXPECT_DOUBLE_EQ(Overlap(ObjectSurface{}, box, 0.045), 0.0);
}

TEST(BoxAround, FindsSizeAndTurnOfAThing) {
  for (const double degrees : {0.0, 20.0, 45.0, 70.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const OrientedBox box = BoxAround(PointsOfBox({0.8, 0.5, 0.3}, angle), kUp);
    EXPECT_NEAR(box.size_m.z(), 0.5, 0.03) << "its height";
    EXPECT_NEAR(std::max(box.size_m.x(), box.size_m.y()), 0.8, 0.04) << degrees;
    EXPECT_NEAR(std::min(box.size_m.x(), box.size_m.y()), 0.3, 0.04) << degrees;
    EXPECT_LT(box.center.norm(), 0.02);
    EXPECT_NEAR((box.rotation * Eigen::Vector3d::UnitZ()).dot(kUp), 1.0, 1e-9);
  }
}

TEST(BoxAround, IgnoresAFewStrayPoints) {
  Points points = PointsOfBox({0.8, 0.5, 0.3}, 0.0);
  for (int i = 0; i < 20; ++i)
    points.emplace_back(3.0F, 2.0F, 1.0F);
  EXPECT_LT(BoxAround(points, kUp).size_m.maxCoeff(), 0.85);
  EXPECT_EQ(BoxAround({}, kUp).size_m, Eigen::Vector3d::Zero());
}

TEST(ExtentOfPoints, LiesBetweenTheMediansOfTheOutermostCoordinates) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 100; ++i)
    points.emplace_back(i, 0.0, -i);
  const Eigen::AlignedBox3d extent = ExtentOfPoints(points);
  EXPECT_DOUBLE_EQ(extent.min().x(), 2.0) << "of 0, 1, 2, 3, 4";
  EXPECT_DOUBLE_EQ(extent.max().x(), 97.0);
  EXPECT_DOUBLE_EQ(extent.min().z(), -97.0);
  EXPECT_DOUBLE_EQ(CentroidOfPoints(points).x(), 49.5);
}

TEST(ExtentOfPoints, IsThePointIfThereIsOne) {
  const std::vector<Eigen::Vector3d> one{{1.0, 2.0, 3.0}};
  EXPECT_EQ(ExtentOfPoints(one).min(), one[0]);
  EXPECT_EQ(ExtentOfPoints(one).max(), one[0]);
}

}  // namespace
}  // namespace cslam
