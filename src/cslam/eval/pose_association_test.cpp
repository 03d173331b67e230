// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/eval/pose_association.h"

#include "cslam/util/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

namespace cslam {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

// Poses at the given milliseconds whose x tells which they are.
Trajectory At(const std::vector<int>& stamps_ms) {
  Trajectory trajectory;
  for (const int ms : stamps_ms)
    trajectory.push_back({Stamp{ms * 1'000'000LL}, Se3({1, 0, 0, 0}, {1.0 * ms, 0.0, 0.0})});
  return trajectory;
}

// (reference, estimate) in milliseconds.
std::vector<std::pair<double, double>> Matches(const PoseAssociation& association) {
  std::vector<std::pair<double, double>> matches;
  for (const PosePair& pair : association.pairs)
    matches.emplace_back(pair.reference.translation.x(), pair.estimate.translation.x());
  return matches;
}

TEST(AssociatePoses, TakesTheNearestStampWhenSeveralAreWithinTheWindow) {
  const PoseAssociation association = AssociatePoses(At({0, 10, 20, 30, 40}), At({12, 38}));
  EXPECT_THAT(Matches(association), ElementsAre(Pair(10, 12), Pair(40, 38)));
  EXPECT_NEAR(association.max_difference_s, 0.002, 1e-12);
  EXPECT_EQ(association.pairs[0].stamp, Stamp{12'000'000});
}

TEST(AssociatePoses, KeepsTheWindowsEdgeAndDropsWhatLiesBeyond) {
  EXPECT_THAT(Matches(AssociatePoses(At({0, 100}), At({20, 121}))), ElementsAre(Pair(0, 20)));
}

TEST(AssociatePoses, GivesAPoseToTheNearerWhenTwoWantIt) {
  EXPECT_THAT(Matches(AssociatePoses(At({0, 100, 200}), At({90, 98, 105}))),
              ElementsAre(Pair(100, 98)));
}

TEST(AssociatePoses, SearchesFromTheShorterSideWhenTheReferenceIsSparse) {
  EXPECT_THAT(Matches(AssociatePoses(At({15, 47}), At({0, 10, 20, 30, 40, 50}))),
              ElementsAre(Pair(15, 10), Pair(47, 50)));
}

TEST(AssociatePoses, CountsPosesAndSharesWhenSomeStayAlone) {
  const PoseAssociation association =
      AssociatePoses(At({0, 100, 200, 300, 400, 500, 600, 700}), At({101, 150, 202, 250}));
  EXPECT_EQ(association.num_reference, 8u);
  EXPECT_EQ(association.num_estimate, 4u);
  EXPECT_DOUBLE_EQ(association.EstimateShare(), 0.5);
  EXPECT_DOUBLE_EQ(association.ReferenceShare(), 0.25);
}

TEST(AssociatePoses, GivesNoPairsWhenATrajectoryIsEmpty) {
  EXPECT_TRUE(AssociatePoses({}, At({1})).pairs.empty());
  EXPECT_TRUE(AssociatePoses(At({1}), {}).pairs.empty());
  EXPECT_EQ(AssociatePoses({}, {}).EstimateShare(), 0.0);
}

TEST(AssociatePoses, InterpolatesTheReferenceWhenAsked) {
  PoseAssociationOptions options;
  options.mode = PoseAssociationMode::kInterpolate;
  const PoseAssociation association =
      AssociatePoses(At({0, 30, 60, 400}), At({0, 12, 59, 100, 401}), options);
  // 100 ms lies in a gap of 340 ms, 401 ms after the end.
  EXPECT_THAT(Matches(association), ElementsAre(Pair(0, 0), Pair(DoubleNear(12, 1e-9), 12),
                                                Pair(DoubleNear(59, 1e-9), 59)));
  EXPECT_EQ(association.max_difference_s, 0.0);
}

TEST(AssociatePoses, ThrowsWhenTheWindowIsNotANumberOfSeconds) {
  PoseAssociationOptions options;
  options.window_s = -0.01;
  EXPECT_THROW(AssociatePoses(At({1}), At({1}), options), Error);
  options.window_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(AssociatePoses(At({1}), At({1}), options), Error);
}

TEST(AssociatePosesOrThrow, SaysWhatEachTrajectoryCoversWhenNothingMatches) {
  try {
    AssociatePosesOrThrow(At({0, 1000}), At({5000, 9500}));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("no poses match (nearest stamp within 0.02 s)"));
    EXPECT_THAT(error.what(), HasSubstr("covers 0.000 to 1.000 s, the estimate 5.000 to 9.500 s"));
  }
  EXPECT_THROW(AssociatePosesOrThrow({}, At({1})), Error);
  EXPECT_THROW(AssociatePosesOrThrow(At({1}), {}), Error);
}

}  // namespace
}  // namespace cslam
