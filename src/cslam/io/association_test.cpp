// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/association.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cslam {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<Stamp> Stamps(const std::vector<std::int64_t>& ns) {
  std::vector<Stamp> stamps;
  for (const std::int64_t value : ns)
    stamps.push_back({value});
  return stamps;
}

TEST(AssociateNearest, PairsInOrderOfTheFirstList) {
  EXPECT_THAT(AssociateNearest(Stamps({0, 100, 200}), Stamps({1, 101, 199}), 5),
              ElementsAre(StampPair{0, 0}, StampPair{1, 1}, StampPair{2, 2}));
}

TEST(AssociateNearest, UsesEachStampOnceAndClosestPairsFirst) {
  // 100 is nearest to both 96 and 101; 101 wins it, and 96 takes what is left within reach.
  EXPECT_THAT(AssociateNearest(Stamps({96, 101}), Stamps({90, 100}), 10),
              ElementsAre(StampPair{0, 0}, StampPair{1, 1}));
  EXPECT_THAT(AssociateNearest(Stamps({96, 101}), Stamps({100}), 10), ElementsAre(StampPair{1, 0}));
}

TEST(AssociateNearest, IncludesTheWindowsBorderAndNothingBeyond) {
  EXPECT_THAT(AssociateNearest(Stamps({0}), Stamps({20}), 20), ElementsAre(StampPair{0, 0}));
  EXPECT_THAT(AssociateNearest(Stamps({0}), Stamps({21}), 20), IsEmpty());
}

TEST(AssociateNearest, GivesTiesToTheEarlierStamps) {
  EXPECT_THAT(AssociateNearest(Stamps({10}), Stamps({5, 15}), 10), ElementsAre(StampPair{0, 0}));
  EXPECT_THAT(AssociateNearest(Stamps({5, 15}), Stamps({10}), 10), ElementsAre(StampPair{0, 0}));
}

TEST(AssociateNearest, FindsNothingInEmptyLists) {
  EXPECT_THAT(AssociateNearest({}, Stamps({1}), 10), IsEmpty());
  EXPECT_THAT(AssociateNearest(Stamps({1}), {}, 10), IsEmpty());
}

}  // namespace
}  // namespace cslam
