// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/util/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>

namespace cslam {
namespace {

// Rendered test sequences depend on these numbers; a change of theirs changes every one of them.
TEST(Rng, GivesTheSameNumbersWithEveryCompiler) {
  Rng rng(1, 2, 3);
  EXPECT_EQ(rng.NextUint64(), 12560079469515091432ULL);
  EXPECT_EQ(rng.NextUint64(), 9643713164311169692ULL);
  EXPECT_EQ(rng.NextUint64(), 4205403975507129051ULL);
}

TEST(Rng, RepeatsItsSequenceForTheSameSeed) {
  Rng a(42, 3, 1);
  Rng b(42, 3, 1);
  for (int i = 0; i < 100; ++i)
    EXPECT_EQ(a.NextUint64(), b.NextUint64());
}

TEST(Rng, DiffersBySeedStreamAndPurpose) {
  std::set<std::uint64_t> first_values;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    for (std::uint64_t stream = 0; stream < 4; ++stream) {
      for (std::uint64_t purpose = 0; purpose < 4; ++purpose) {
        first_values.insert(Rng(seed, stream, purpose).NextUint64());
      }
    }
  }
  EXPECT_EQ(first_values.size(), 64U);
}

TEST(Rng, UniformStaysInItsHalfOpenRangeWithTheRightMoments) {
  constexpr int kCount = 20'000;
  Rng rng(1);
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double value = rng.Uniform();
    ASSERT_GE(value, 0.0);
    ASSERT_LT(value, 1.0);
    sum += value;
    sum_of_squares += value * value;
  }
  const double mean = sum / kCount;
  EXPECT_NEAR(mean, 0.5, 0.01);
  EXPECT_NEAR(sum_of_squares / kCount - mean * mean, 1.0 / 12.0, 0.005);
}

TEST(Rng, UniformScalesToTheBoundsGiven) {
  Rng rng(2);
  for (int i = 0; i < 1000; ++i) {
    const double value = rng.Uniform(-3.0, 5.0);
    ASSERT_GE(value, -3.0);
    ASSERT_LT(value, 5.0);
  }
}

TEST(Rng, IndexReachesEveryValueAboutEquallyOften) {
  constexpr int kCount = 10'000;
  Rng rng(3);
  std::array<int, 10> counts{};
  for (int i = 0; i < kCount; ++i)
    ++counts.at(rng.Index(counts.size()));
  for (const int count : counts)
    EXPECT_NEAR(count, 1000, 150);
}

TEST(Rng, GaussianHasZeroMeanAndUnitVariance) {
  constexpr int kCount = 20'000;
  Rng rng(4);
  double sum = 0.0;
  double sum_of_squares = 0.0;
  int num_beyond_two = 0;
  for (int i = 0; i < kCount; ++i) {
    const double value = rng.Gaussian();
    ASSERT_TRUE(std::isfinite(value));
    sum += value;
    sum_of_squares += value * value;
    if (std::abs(value) > 2.0) ++num_beyond_two;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.03);
  EXPECT_NEAR(sum_of_squares / kCount, 1.0, 0.05);
  EXPECT_NEAR(static_cast<double>(num_beyond_two) / kCount, 0.0455, 0.01);
}

}  // namespace
}  // namespace cslam
