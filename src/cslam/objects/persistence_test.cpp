// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/persistence.h"

#include <gtest/gtest.h>

#include <limits>

namespace cslam {
namespace {

const PersistenceOptions kOptions;

// The belief after count equal views, from one of start.
double After(int count, double log_ratio, double start = 0.5) {
  double log_odds = LogOdds(start);
  for (int i = 0; i < count; ++i)
    log_odds = UpdatedLogOdds(log_odds, log_ratio, kOptions);
  return Probability(log_odds);
}

TEST(LogOdds, AndProbabilityAreInverses) {
  for (const double p : {0.02, 0.3, 0.5, 0.75, 0.98})
    EXPECT_NEAR(Probability(LogOdds(p)), p, 1e-12);
  EXPECT_EQ(LogOdds(0.5), 0.0);
}

TEST(UpdatedLogOdds, IsBayesRule) {
  const double ratio = LookedThroughLogRatio(kOptions);
  const double there = kOptions.p_through_there;
  const double gone = kOptions.p_through_gone;
  EXPECT_NEAR(After(1, ratio, 0.7), 0.7 * there / (0.7 * there + 0.3 * gone), 1e-12);
}

TEST(UpdatedLogOdds, StaysWithinBoundsSoThatBeliefsCanTurn) {
  EXPECT_NEAR(After(1000, SeenLogRatio(0.0, 0.9, kOptions)), kOptions.max_belief, 1e-9);
  EXPECT_NEAR(After(1000, LookedThroughLogRatio(kOptions)), 1.0 - kOptions.max_belief, 1e-9);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(After(1, infinity), kOptions.max_belief, 1e-9);
}

TEST(SeenLogRatio, ActivatesAfterAFewGoodViews) {
  const double ratio = SeenLogRatio(0.1, 0.7, kOptions);
  EXPECT_LT(After(0, ratio), kOptions.activate_at);
  EXPECT_GE(After(2, ratio), kOptions.activate_at);
}

TEST(SeenLogRatio, FallsWithDistanceAndRisesWithScore) {
  EXPECT_GT(SeenLogRatio(0.1, 0.5, kOptions), SeenLogRatio(0.4, 0.5, kOptions));
  EXPECT_GT(SeenLogRatio(0.1, 0.9, kOptions), SeenLogRatio(0.1, 0.4, kOptions));
  EXPECT_LT(SeenLogRatio(1.5, 0.9, kOptions), 0.0) << "so far off it is another";
}

TEST(SeenLogRatio, IsBoundedForThingsFarAway) {
  const double bound = SeenLogRatio(100.0, 0.9, kOptions);
  EXPECT_GT(bound, -5.0);
  EXPECT_DOUBLE_EQ(SeenLogRatio(1e9, 0.9, kOptions), bound);
}

TEST(LookedThroughLogRatio, MakesASureObjectAbsentAfterThreeOrFourViews) {
  const double ratio = LookedThroughLogRatio(kOptions);
  EXPECT_GE(After(1, ratio, kOptions.max_belief), kOptions.deactivate_at) << "one view may err";
  EXPECT_LT(After(4, ratio, kOptions.max_belief), kOptions.absent_at);
}

TEST(MissedLogRatio, SpeaksLessThanLookingThrough) {
  EXPECT_LT(MissedLogRatio(kOptions), 0.0);
  EXPECT_GT(MissedLogRatio(kOptions), LookedThroughLogRatio(kOptions));
}

TEST(PersistenceOptions, LeaveAGapBetweenTheThresholds) {
  EXPECT_LT(kOptions.deactivate_at, kOptions.activate_at);
  EXPECT_GT(kOptions.deactivate_at, 0.5);
  EXPECT_LT(kOptions.erase_at, kOptions.absent_at);
}

}  // namespace
}  // namespace cslam
