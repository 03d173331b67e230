// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/run_accuracy.h"

#include "cslam/io/trajectory_file.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace cslam {
namespace {

using testing::AllOf;
using testing::Each;
using testing::HasSubstr;

// A quarter turn per second on a circle of the given radius, 10 Hz.
Trajectory Circle(double radius_m) {
  Trajectory trajectory;
  for (int i = 0; i < 40; ++i) {
    const double angle_rad = 0.05 * static_cast<double>(i) * M_PI;
    Se3 T_world_camera;
    T_world_camera.translation = {radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad),
                                  0.0};
    trajectory.push_back({Stamp{100'000'000LL * i}, T_world_camera});
  }
  return trajectory;
}

Trajectory Line() {
  Trajectory trajectory = Circle(1.0);
  for (StampedPose& pose : trajectory)
    pose.T_world_camera.translation.y() = 0.0;
  return trajectory;
}

TEST(MeasureAccuracy, MeasuresBothTrajectories) {
  const TestFolder folder;
  WriteTrajectory(folder / "groundtruth.txt", Circle(1.0));
  const RunAccuracy accuracy =
      MeasureAccuracy(folder / "groundtruth.txt", Circle(1.0), Circle(1.1));
  EXPECT_NEAR(accuracy.final_poses.ate.value().statistics_m.rmse, 0.0, 1e-6);
  EXPECT_NEAR(accuracy.live_poses.ate.value().statistics_m.rmse, 0.1, 1e-6);
  EXPECT_NEAR(accuracy.final_poses.rpe.value().translation_m.rmse, 0.0, 1e-6);
  EXPECT_GT(accuracy.live_poses.rpe.value().translation_m.rmse, 0.01);
  EXPECT_TRUE(accuracy.problems.empty());
}

TEST(MeasureAccuracy, TakesMotionOfTheCameraWhereItIsKnown) {
  const TestFolder folder;
  WriteTrajectory(folder / "groundtruth.txt", Circle(1.0));
  WriteTrajectory(folder / "groundtruth_camera.txt", Circle(1.1));
  const RunAccuracy accuracy =
      MeasureAccuracy(folder / "groundtruth.txt", Circle(1.1), Circle(1.1));
  EXPECT_NEAR(accuracy.final_poses.rpe.value().translation_m.rmse, 0.0, 1e-6);
  EXPECT_NEAR(accuracy.final_poses.ate.value().statistics_m.rmse, 0.1, 1e-6);
  EXPECT_THAT(accuracy.rpe_reference, HasSubstr("groundtruth_camera.txt"));
}

TEST(MeasureAccuracy, TellsTheProblemOnceWhenGroundTruthIsBroken) {
  const TestFolder folder;
  const auto file = folder.Write("groundtruth.txt", "0 1 2\n");
  const RunAccuracy accuracy = MeasureAccuracy(file, Circle(1.0), Circle(1.0));
  EXPECT_FALSE(accuracy.final_poses.ate || accuracy.live_poses.rpe);
  EXPECT_EQ(accuracy.problems.size(), 2U);
  EXPECT_THAT(accuracy.problems,
              Each(AllOf(HasSubstr("cannot be measured"), HasSubstr("groundtruth.txt:1"))));
}

TEST(MeasureAccuracy, StillMeasuresMotionWhenTheAlignmentIsOpen) {
  const TestFolder folder;
  WriteTrajectory(folder / "groundtruth.txt", Line());
  const RunAccuracy accuracy = MeasureAccuracy(folder / "groundtruth.txt", Line(), Line());
  EXPECT_FALSE(accuracy.final_poses.ate);
  EXPECT_TRUE(accuracy.final_poses.rpe);
  EXPECT_EQ(accuracy.problems.size(), 1U);
}

}  // namespace
}  // namespace cslam
