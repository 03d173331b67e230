// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/util/latest.h"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

namespace cslam {
namespace {

TEST(Latest, IsNullBeforeTheFirstValue) {
  const Latest<int> latest;
  EXPECT_EQ(latest.Get(), nullptr);
}

TEST(Latest, GivesTheNewestValueAsOftenAsAsked) {
  Latest<int> latest;
  latest.Publish(std::make_shared<const int>(1));
  latest.Publish(std::make_shared<const int>(2));
  EXPECT_EQ(*latest.Get(), 2);
  EXPECT_EQ(*latest.Get(), 2);
}

TEST(Latest, ReleasesTheValueBeforeWhenNobodyReadsIt) {
  Latest<int> latest;
  const auto first = std::make_shared<const int>(1);
  latest.Publish(first);
  const auto held = latest.Get();
  EXPECT_EQ(first.use_count(), 3);
  latest.Publish(std::make_shared<const int>(2));
  EXPECT_EQ(first.use_count(), 2) << "only first and held may be left";
  EXPECT_EQ(*held, 1);
}

TEST(Latest, MayBePublishedAndReadAtTheSameTime) {
  constexpr int kCount = 2000;
  Latest<int> latest;
  latest.Publish(std::make_shared<const int>(0));
  const std::jthread writer([&] {
    for (int i = 1; i <= kCount; ++i)
      latest.Publish(std::make_shared<const int>(i));
  });
  int previous = 0;
  while (previous < kCount) {
    const int value = *latest.Get();
    ASSERT_GE(value, previous) << "a newer value was replaced by an older one";
    previous = value;
  }
}

}  // namespace
}  // namespace cslam
