// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/eval/ate.h"

#include "cslam/util/check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace cslam {
namespace {

// A winding path that fills three dimensions, one pose every 0.1 s.
Trajectory Winding(int num_poses) {
  Trajectory trajectory;
  for (int i = 0; i < num_poses; ++i) {
    const double s = 0.1 * i;
    trajectory.push_back(
        {Stamp{100'000'000LL * i},
         Se3(ExpSo3({0.1 * s, 0.3 * s, -0.2 * s}), {std::cos(s), std::sin(2.0 * s), 0.3 * s})});
  }
  return trajectory;
}

Trajectory Moved(const Trajectory& trajectory, const Se3& T_new_old, double scale = 1.0) {
  Trajectory moved;
  for (const auto& [stamp, T] : trajectory)
    moved.push_back({stamp, T_new_old * Se3(T.rotation, scale * T.translation)});
  return moved;
}

Trajectory FromCentres(const std::vector<Eigen::Vector3d>& centres_m) {
  Trajectory trajectory;
  for (std::size_t i = 0; i < centres_m.size(); ++i) {
    trajectory.push_back({Stamp{100'000'000LL * static_cast<std::int64_t>(i)},
                          Se3(Eigen::Quaterniond::Identity(), centres_m[i])});
  }
  return trajectory;
}

const Se3 kMotion(ExpSo3({0.4, -1.1, 2.0}), {3.0, -2.0, 0.5});

TEST(EvaluateAte, IsZeroWhenTheEstimateIsOnlyInAnotherFrame) {
  const Trajectory reference = Winding(60);
  const AteResult result = EvaluateAte(reference, Moved(reference, kMotion));
  EXPECT_LT(result.statistics_m.max, 1e-12);
  EXPECT_EQ(result.statistics_m.count, 60u);
  const PoseDifference difference = Difference(result.alignment.T_a_b, kMotion.Inverse());
  EXPECT_LT(difference.angle_rad, 1e-12);
  EXPECT_LT(difference.distance_m, 1e-12);
}

TEST(EvaluateAte, SeesTheFrameWhenNotAligned) {
  const Trajectory reference = Winding(20);
  AteOptions options;
  options.alignment = TrajectoryAlignment::kNone;
  const Trajectory shifted = Moved(reference, Se3({1, 0, 0, 0}, {0.3, 0.0, 0.4}));
  const AteResult result = EvaluateAte(reference, shifted, options);
  EXPECT_NEAR(result.statistics_m.rmse, 0.5, 1e-12);
  EXPECT_NEAR(result.statistics_m.std, 0.0, 1e-7);
}

TEST(EvaluateAte, KeepsAWrongScaleWhenAlignedWithoutScale) {
  const Trajectory reference = Winding(60);
  const Trajectory shrunk = Moved(reference, kMotion, 0.9);
  EXPECT_GT(EvaluateAte(reference, shrunk).statistics_m.rmse, 0.05);

  AteOptions options;
  options.alignment = TrajectoryAlignment::kSim3;
  const AteResult result = EvaluateAte(reference, shrunk, options);
  EXPECT_LT(result.statistics_m.max, 1e-12);
  EXPECT_NEAR(result.alignment.scale, 1.0 / 0.9, 1e-12);
}

TEST(EvaluateAte, MakesTheFirstPosesCoincideWhenAlignedAtTheOrigin) {
  const Trajectory reference = Winding(30);
  Trajectory estimate = Moved(reference, kMotion);
  estimate.back().T_world_camera.translation.z() += 0.7;
  AteOptions options;
  options.alignment = TrajectoryAlignment::kOrigin;
  const AteResult result = EvaluateAte(reference, estimate, options);
  EXPECT_NEAR(result.errors_m.front(), 0.0, 1e-12);
  EXPECT_NEAR(result.errors_m.back(), 0.7, 1e-12);
  EXPECT_EQ(result.statistics_m.max_index, 29u);
}

TEST(EvaluateAte, GivesTheHandComputedErrorWhenASquareIsStretched) {
  // A unit square against a rectangle of 1.2 x 0.8: the best rigid fit is the common centre, and
  // every corner is off by (0.1, 0.1).
  const Trajectory reference = FromCentres({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const Trajectory estimate = FromCentres({{5, 0, 0}, {6.2, 0, 0}, {6.2, 0.8, 0}, {5, 0.8, 0}});
  const AteResult result = EvaluateAte(reference, estimate);
  EXPECT_NEAR(result.statistics_m.rmse, 0.1 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(result.statistics_m.sse, 0.08, 1e-12);
  EXPECT_NEAR(result.statistics_m.min, result.statistics_m.max, 1e-12);
}

TEST(EvaluateAte, ThrowsWhenThePairsLeaveTheAlignmentOpen) {
  const Trajectory line = FromCentres({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}});
  EXPECT_THROW(EvaluateAte(line, line), Error);
  const Trajectory two = FromCentres({{0, 0, 0}, {1, 0, 0}});
  EXPECT_THROW(EvaluateAte(two, two), Error);
  AteOptions options;
  options.alignment = TrajectoryAlignment::kNone;
  EXPECT_EQ(EvaluateAte(line, line, options).statistics_m.max, 0.0);
}

TEST(Align, MovesWholePosesWhenTheAlignmentIsRigid) {
  const Trajectory reference = Winding(15);
  const Trajectory estimate = Moved(reference, kMotion);
  const Trajectory aligned = Align(EvaluateAte(reference, estimate).alignment, estimate);
  ASSERT_EQ(aligned.size(), reference.size());
  for (std::size_t i = 0; i < aligned.size(); ++i) {
    const PoseDifference difference =
        Difference(reference[i].T_world_camera, aligned[i].T_world_camera);
    EXPECT_LT(difference.distance_m, 1e-12);
    EXPECT_LT(difference.angle_rad, 1e-12);
  }
}

}  // namespace
}  // namespace cslam
