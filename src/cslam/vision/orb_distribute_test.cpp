// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/vision/orb_distribute.h"

#include "cslam/util/random.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace cslam::orb {
namespace {

using testing::ElementsAre;

const cv::Rect kArea(18, 18, 600, 440);

Candidate At(int x, int y, int score) {
  return {static_cast<std::int16_t>(x), static_cast<std::int16_t>(y),
          static_cast<std::uint8_t>(score)};
}

// Three quarters of the candidates, and the stronger ones, in the left tenth of the area.
std::vector<Candidate> Clustered(int count) {
  Rng rng(3);
  std::vector<Candidate> candidates;
  std::set<std::pair<int, int>> taken;
  while (static_cast<int>(candidates.size()) < count) {
    const bool is_left = rng.Uniform() < 0.75;
    const auto width = static_cast<std::uint64_t>(is_left ? kArea.width / 10 : kArea.width);
    const int x = kArea.x + static_cast<int>(rng.Index(width));
    const int y = kArea.y + static_cast<int>(rng.Index(static_cast<std::uint64_t>(kArea.height)));
    const int score = (is_left ? 60 : 21) + static_cast<int>(rng.Index(20));
    if (taken.insert({x, y}).second) candidates.push_back(At(x, y, score));
  }
  return candidates;
}

std::multiset<std::tuple<int, int, int>> Sorted(const std::vector<Candidate>& candidates) {
  std::multiset<std::tuple<int, int, int>> sorted;
  for (const Candidate& c : candidates)
    sorted.emplace(c.y, c.x, c.score);
  return sorted;
}

TEST(SelectEvenly, CoversTheAreaWhenStrongCandidatesCluster) {
  const std::vector<Candidate> selected = SelectEvenly(Clustered(3000), kArea, 300, BestSimd());
  ASSERT_EQ(selected.size(), 300U);
  std::set<std::pair<int, int>> cells;
  for (const Candidate& c : selected)
    cells.emplace(c.x / 60, c.y / 60);
  EXPECT_GT(cells.size(), 70U);  // of 88
}

TEST(SelectEvenly, PrefersTheStrongerOfNeighbours) {
  const std::vector<Candidate> candidates = {At(100, 100, 30), At(104, 100, 90), At(400, 300, 25)};
  const auto selected = Sorted(SelectEvenly(candidates, kArea, 2, BestSimd()));
  EXPECT_THAT(selected, ElementsAre(std::tuple(100, 104, 90), std::tuple(300, 400, 25)));
}

TEST(SelectEvenly, KeepsNeighboursOfEqualStrengthBeforeWeakOnesNearStrongOnes) {
  const std::vector<Candidate> candidates = {At(100, 100, 80), At(110, 100, 80), At(400, 300, 80),
                                             At(425, 300, 20)};
  const auto selected = Sorted(SelectEvenly(candidates, kArea, 3, BestSimd()));
  EXPECT_FALSE(selected.contains(std::tuple(300, 425, 20)));
}

TEST(SelectEvenly, ReturnsAllWhenThereAreNotMoreThanWanted) {
  const std::vector<Candidate> candidates = Clustered(50);
  EXPECT_EQ(Sorted(SelectEvenly(candidates, kArea, 50, BestSimd())), Sorted(candidates));
  EXPECT_TRUE(SelectEvenly(candidates, kArea, 0, BestSimd()).empty());
}

TEST(SelectEvenly, DoesNotDependOnOrderOrInstructionSet) {
  std::vector<Candidate> candidates = Clustered(2000);
  const auto expected = Sorted(SelectEvenly(candidates, kArea, 333, BestSimd()));
  EXPECT_EQ(Sorted(SelectEvenly(candidates, kArea, 333, Simd::kBaseline)), expected);
  std::ranges::reverse(candidates);
  EXPECT_EQ(Sorted(SelectEvenly(candidates, kArea, 333, BestSimd())), expected);
}

TEST(ThinOut, KeepsTheBestWeakCandidateOnlyWhereACellHasNoStrongOne) {
  const std::vector<Candidate> candidates = {At(20, 20, 15),  At(25, 25, 40),   At(30, 20, 21),
                                             At(320, 220, 8), At(325, 225, 12), At(330, 220, 9)};
  EXPECT_THAT(
      Sorted(ThinOut(candidates, kArea, 20, 100)),
      ElementsAre(std::tuple(20, 30, 21), std::tuple(25, 25, 40), std::tuple(225, 325, 12)));
}

TEST(ThinOut, BoundsTheNumberPerCellButNotBelowWhatIsWanted) {
  std::vector<Candidate> candidates;
  for (int y = kArea.y; y < kArea.br().y; y += 2) {
    for (int x = kArea.x; x < kArea.br().x; x += 2)
      candidates.push_back(At(x, y, 30 + x % 7));
  }
  EXPECT_LE(ThinOut(candidates, kArea, 20, 200).size(), 16U * 20 * 14);
  EXPECT_GE(ThinOut(candidates, kArea, 20, 10'000).size(), 10'000U);
}

TEST(SplitCount, FollowsTheSharesWhenAllLevelsHaveEnough) {
  EXPECT_THAT(SplitCount(100, {4.0, 3.0, 3.0}, {1000, 1000, 1000}), ElementsAre(40, 30, 30));
}

TEST(SplitCount, GivesToOthersWhatALevelCannotUse) {
  EXPECT_THAT(SplitCount(90, {1.0, 1.0, 1.0}, {10, 1000, 1000}), ElementsAre(10, 40, 40));
  EXPECT_THAT(SplitCount(100, {2.0, 1.0, 1.0}, {10, 20, 1000}), ElementsAre(10, 20, 70));
}

TEST(SplitCount, GivesAllThereIsWhenThatIsTooLittle) {
  EXPECT_THAT(SplitCount(100, {1.0, 1.0}, {10, 20}), ElementsAre(10, 20));
  EXPECT_THAT(SplitCount(100, {1.0, 1.0}, {0, 0}), ElementsAre(0, 0));
}

TEST(SplitCount, SumsToTheTotalWhenSharesDoNotDivideIt) {
  const std::vector<int> counts = SplitCount(7, {1.0, 0.9, 0.8, 0.1}, {50, 50, 50, 50});
  EXPECT_EQ(counts[0] + counts[1] + counts[2] + counts[3], 7);
}

}  // namespace
}  // namespace cslam::orb
