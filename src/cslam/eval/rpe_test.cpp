// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/eval/rpe.h"

#include "cslam/util/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace cslam {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

// step_m forward along x in every 0.1 s.
Trajectory Straight(int num_poses, double step_m) {
  Trajectory trajectory;
  for (int i = 0; i < num_poses; ++i) {
    trajectory.push_back(
        {Stamp{100'000'000LL * i}, Se3(Eigen::Quaterniond::Identity(), {step_m * i, 0.0, 0.0})});
  }
  return trajectory;
}

std::vector<std::pair<std::size_t, std::size_t>> Indices(const RpeResult& result) {
  std::vector<std::pair<std::size_t, std::size_t>> indices;
  for (const RelativeError& error : result.errors)
    indices.emplace_back(error.first, error.last);
  return indices;
}

TEST(EvaluateRpe, IsZeroWhenTheEstimateIsOnlyInAnotherFrame) {
  Trajectory reference;
  Trajectory estimate;
  const Se3 motion(ExpSo3({0.4, -1.1, 2.0}), {3.0, -2.0, 0.5});
  for (int i = 0; i < 20; ++i) {
    const Se3 T(ExpSo3({0.1 * i, 0.2, -0.05 * i}), {0.2 * i, 0.01 * i * i, 1.0});
    reference.push_back({Stamp{33'000'000LL * i}, T});
    estimate.push_back({Stamp{33'000'000LL * i}, motion * T});
  }
  const RpeResult result = EvaluateRpe(reference, estimate);
  EXPECT_EQ(result.errors.size(), 19u);
  EXPECT_LT(result.translation_m.max, 1e-12);
  EXPECT_LT(result.rotation_rad.max, 1e-12);
}

TEST(EvaluateRpe, ShowsAJumpOnceWhenPosesAreConsecutive) {
  const Trajectory reference = Straight(10, 0.1);
  Trajectory estimate = reference;
  for (std::size_t i = 6; i < estimate.size(); ++i)
    estimate[i].T_world_camera.translation.y() += 0.05;
  const RpeResult result = EvaluateRpe(reference, estimate);
  EXPECT_NEAR(result.translation_m.max, 0.05, 1e-12);
  EXPECT_EQ(result.translation_m.max_index, 5u);
  EXPECT_EQ(result.errors[5].last, 6u);
  EXPECT_NEAR(result.translation_m.sse, 0.0025, 1e-12);
}

TEST(EvaluateRpe, MeasuresDriftPerDeltaWhenTheStepIsWrong) {
  // 10 % too long a step: 1 cm in each frame, 5 cm in five.
  RpeOptions options;
  options.delta = 5.0;
  const RpeResult result = EvaluateRpe(Straight(11, 0.1), Straight(11, 0.11), options);
  EXPECT_THAT(Indices(result), ElementsAre(Pair(0, 5), Pair(5, 10)));
  EXPECT_NEAR(result.translation_m.mean, 0.05, 1e-12);
}

TEST(EvaluateRpe, GivesTheTurnWhenOnlyTheRotationDrifts) {
  const Trajectory reference = Straight(5, 0.1);
  Trajectory estimate = reference;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    estimate[i].T_world_camera.rotation = ExpSo3({0.0, 0.0, 0.02 * static_cast<double>(i)});
  }
  const RpeResult result = EvaluateRpe(reference, estimate);
  EXPECT_NEAR(result.rotation_rad.min, 0.02, 1e-12);
  EXPECT_NEAR(result.rotation_rad.max, 0.02, 1e-12);
}

TEST(EvaluateRpe, BeginsAtEveryPoseWhenAllPairsAreAsked) {
  RpeOptions options;
  options.delta = 2.0;
  options.pairs = RpePairs::kAll;
  EXPECT_THAT(Indices(EvaluateRpe(Straight(5, 0.1), Straight(5, 0.1), options)),
              ElementsAre(Pair(0, 2), Pair(1, 3), Pair(2, 4)));
}

TEST(EvaluateRpe, SpansTheTimeAskedForWhenDeltaIsInSeconds) {
  RpeOptions options;
  options.delta = 0.3;
  options.unit = DeltaUnit::kSeconds;
  EXPECT_THAT(Indices(EvaluateRpe(Straight(8, 0.1), Straight(8, 0.1), options)),
              ElementsAre(Pair(0, 3), Pair(3, 6)));
}

TEST(EvaluateRpe, SkipsStartsThatHaveNoPartnerWhenPosesAreMissing) {
  Trajectory reference = Straight(10, 0.1);
  reference.erase(reference.begin() + 3, reference.begin() + 6);  // 0.3 to 0.5 s
  RpeOptions options;
  options.delta = 0.2;
  options.unit = DeltaUnit::kSeconds;
  // Left: 0, 0.1, 0.2, 0.6, 0.7, 0.8, 0.9 s.
  EXPECT_THAT(Indices(EvaluateRpe(reference, reference, options)),
              ElementsAre(Pair(0, 2), Pair(3, 5)));
}

TEST(EvaluateRpe, FollowsThePathOfTheReferenceWhenDeltaIsInMetres) {
  RpeOptions options;
  options.delta = 0.5;
  options.unit = DeltaUnit::kMetres;
  const RpeResult result = EvaluateRpe(Straight(11, 0.25), Straight(11, 0.3), options);
  ASSERT_EQ(result.errors.size(), 5u);
  EXPECT_EQ(result.errors[0].last, 2u);
  EXPECT_NEAR(result.translation_m.mean, 0.1, 1e-12);
}

TEST(EvaluateRpe, ThrowsWhenDeltaMakesNoSense) {
  const Trajectory trajectory = Straight(5, 0.1);
  const auto with = [](double delta, DeltaUnit unit) {
    RpeOptions options;
    options.delta = delta;
    options.unit = unit;
    return options;
  };
  EXPECT_THROW(EvaluateRpe(trajectory, trajectory, with(0.0, DeltaUnit::kFrames)), Error);
  EXPECT_THROW(EvaluateRpe(trajectory, trajectory, with(1.5, DeltaUnit::kFrames)), Error);
  EXPECT_THROW(EvaluateRpe(trajectory, trajectory, with(-1.0, DeltaUnit::kSeconds)), Error);
  // More than there is.
  EXPECT_THROW(EvaluateRpe(trajectory, trajectory, with(5.0, DeltaUnit::kFrames)), Error);
  EXPECT_THROW(EvaluateRpe(trajectory, trajectory, with(7.0, DeltaUnit::kMetres)), Error);
}

}  // namespace
}  // namespace cslam
