// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/util/id.h"

#include <gtest/gtest.h>

#include <type_traits>
#include <unordered_set>

namespace cslam {
namespace {

// Ids of different kinds neither convert nor compare, and none is made from a number by accident.
static_assert(!std::is_convertible_v<KeyframeId, PointId>);
static_assert(!std::is_constructible_v<KeyframeId, PointId>);
static_assert(!std::is_convertible_v<int, KeyframeId>);
static_assert(!std::is_convertible_v<KeyframeId, int>);
template <typename A, typename B>
concept Comparable = requires(A a, B b) {
  a == b;
};
static_assert(Comparable<PointId, PointId>);
static_assert(!Comparable<PointId, KeyframeId>);
static_assert(!Comparable<PointId, int>);

TEST(Id, IsInvalidUntilGivenAValue) {
  EXPECT_FALSE(FrameId().valid());
  EXPECT_TRUE(FrameId(0).valid());
  EXPECT_NE(FrameId(), FrameId(0));
  EXPECT_EQ(FrameId(), FrameId());
}

TEST(Id, OrdersByValueWithInvalidLast) {
  EXPECT_LT(PointId(1), PointId(2));
  EXPECT_LT(PointId(4'000'000'000U), PointId());
  EXPECT_EQ(PointId(7).value(), 7U);
  EXPECT_EQ(PointId(7).index(), std::size_t{7});
}

TEST(Id, CanBeAKeyOfHashedContainers) {
  const std::unordered_set<MapId> ids{MapId(1), MapId(2), MapId(1)};
  EXPECT_EQ(ids.size(), 2U);
  EXPECT_TRUE(ids.contains(MapId(2)));
}

}  // namespace
}  // namespace cslam
