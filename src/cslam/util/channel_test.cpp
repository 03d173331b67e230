// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/util/channel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

namespace cslam {
namespace {

TEST(Channel, DeliversInOrder) {
  Channel<int> channel(3);
  for (int i = 0; i < 3; ++i)
    EXPECT_TRUE(channel.Push(i));
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(channel.Pop(), i);
  EXPECT_FALSE(channel.HasWaiting());
}

TEST(Channel, MovesWhatCannotBeCopied) {
  Channel<std::unique_ptr<int>> channel(1);
  channel.Push(std::make_unique<int>(5));
  EXPECT_EQ(**channel.Pop(), 5);
}

TEST(Channel, DropsTheOldestAndCountsWhenToldSo) {
  Channel<int> channel(2, OnFull::kDropOldest);
  for (int i = 0; i < 5; ++i)
    EXPECT_TRUE(channel.Push(i));
  EXPECT_EQ(channel.Pop(), 3);
  EXPECT_EQ(channel.Pop(), 4);
  EXPECT_EQ(channel.stats().pushed, 5U);
  EXPECT_EQ(channel.stats().dropped, 3U);
  EXPECT_EQ(channel.stats().high_water_mark, 2U);
}

TEST(Channel, FeedbackIgnoresTheCapacity) {
  Channel<int> channel(1);
  for (int i = 0; i < 4; ++i)
    EXPECT_TRUE(channel.PushFeedback(i));
  EXPECT_EQ(channel.stats().high_water_mark, 4U);
  EXPECT_EQ(channel.stats().dropped, 0U);
}

TEST(Channel, CanBeDrainedAfterItIsClosedButTakesNothingMore) {
  Channel<int> channel(2);
  channel.Push(1);
  channel.Close();
  EXPECT_FALSE(channel.Push(2));
  EXPECT_FALSE(channel.PushFeedback(3));
  EXPECT_EQ(channel.Pop(), 1);
  EXPECT_EQ(channel.Pop(), std::nullopt);
  EXPECT_EQ(channel.stats().pushed, 1U);
}

TEST(Channel, CloseWakesAWaitingReader) {
  Channel<int> channel(1);
  std::optional<int> result = 1;
  std::thread reader([&] { result = channel.Pop(); });
  channel.Close();
  reader.join();
  EXPECT_EQ(result, std::nullopt);
}

TEST(Channel, CloseWakesAWaitingWriter) {
  Channel<int> channel(1);
  channel.Push(1);
  bool accepted = true;
  std::thread writer([&] { accepted = channel.Push(2); });
  channel.Close();
  writer.join();
  EXPECT_FALSE(accepted);
}

TEST(Channel, NeverHoldsMoreThanItsCapacityWhileAWriterIsFaster) {
  constexpr int kCount = 2000;
  Channel<int> channel(3);
  std::thread writer([&] {
    for (int i = 0; i < kCount; ++i)
      channel.Push(i);
    channel.Close();
  });
  int expected = 0;
  while (const std::optional<int> value = channel.Pop())
    EXPECT_EQ(*value, expected++);
  writer.join();
  EXPECT_EQ(expected, kCount);
  EXPECT_LE(channel.stats().high_water_mark, 3U);
}

TEST(Channel, DeliversEachItemOnceToManyReadersFromManyWriters) {
  constexpr int kThreads = 3;
  constexpr int kCount = 500;
  constexpr std::size_t kTotal = std::size_t{kThreads} * kCount;
  Channel<int> channel(4);
  std::vector<std::atomic<int>> seen(kTotal);
  std::vector<std::thread> writers;
  std::vector<std::thread> readers;
  for (int t = 0; t < kThreads; ++t) {
    writers.emplace_back([&channel, t] {
      for (int i = 0; i < kCount; ++i)
        channel.Push(t * kCount + i);
    });
    readers.emplace_back([&channel, &seen] {
      while (const std::optional<int> value = channel.Pop())
        ++seen[static_cast<std::size_t>(*value)];
    });
  }
  for (std::thread& writer : writers)
    writer.join();
  channel.Close();
  for (std::thread& reader : readers)
    reader.join();
  for (const std::atomic<int>& count : seen)
    EXPECT_EQ(count.load(), 1);
}

TEST(Channel, DiscardThrowsAwayWhatWaits) {
  Channel<int> channel(2);
  channel.Push(1);
  channel.Push(2);
  channel.Discard();
  EXPECT_FALSE(channel.HasWaiting());
  channel.Push(3);
  EXPECT_EQ(channel.Pop(), 3);
}

}  // namespace
}  // namespace cslam
