// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/util/cow_array.h"

#include "cslam/util/random.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <thread>
#include <vector>

namespace cslam {
namespace {

using SmallChunks = CowArray<int, 4>;

SmallChunks MakeArray(int size) {
  SmallChunks array;
  for (int i = 0; i < size; ++i)
    array.PushBack(i);
  return array;
}

std::vector<int> Contents(const SmallChunks& array) {
  std::vector<int> contents;
  for (std::size_t i = 0; i < array.size(); ++i)
    contents.push_back(array[i]);
  return contents;
}

TEST(CowArray, HoldsWhatWasPushed) {
  const SmallChunks array = MakeArray(10);
  ASSERT_EQ(array.size(), 10U);
  for (int i = 0; i < 10; ++i)
    EXPECT_EQ(array[static_cast<std::size_t>(i)], i);
}

TEST(CowArray, CopyStaysAsItWasWhenOwnerEdits) {
  SmallChunks array = MakeArray(10);
  const SmallChunks copy = array.Share();
  array.Edit(5) = 500;
  EXPECT_EQ(array[5], 500);
  EXPECT_EQ(copy[5], 5);
}

TEST(CowArray, CopyStaysAsItWasWhenOwnerAppendsToSharedChunk) {
  SmallChunks array = MakeArray(6);
  const SmallChunks copy = array.Share();
  array.PushBack(6);
  EXPECT_EQ(array.size(), 7U);
  EXPECT_EQ(copy.size(), 6U);
  EXPECT_EQ(copy[5], 5);
  EXPECT_NE(&array[5], &copy[5]) << "the chunk that grew was cloned first";
}

TEST(CowArray, CopySharesChunksNobodyEdited) {
  SmallChunks array = MakeArray(12);
  const SmallChunks copy = array.Share();
  array.Edit(5) = 500;
  EXPECT_EQ(&array[0], &copy[0]);
  EXPECT_NE(&array[4], &copy[4]);
  EXPECT_EQ(&array[8], &copy[8]);
}

TEST(CowArray, ClonesAChunkOnlyOnFirstEditAfterShare) {
  SmallChunks array = MakeArray(8);
  const SmallChunks copy = array.Share();
  int* const first = &array.Edit(1);
  int* const second = &array.Edit(1);
  EXPECT_EQ(first, second);
  const SmallChunks next = array.Share();
  EXPECT_NE(&array.Edit(1), first) << "a copy holds the chunk again";
}

TEST(CowArray, EditsInPlaceWithoutCopies) {
  SmallChunks array = MakeArray(8);
  const int* const before = &array[1];
  EXPECT_EQ(&array.Edit(1), before);
}

TEST(CowArray, EditBehindTheEndIsAnInternalError) {
  SmallChunks array = MakeArray(8);
  EXPECT_THROW(array.Edit(8), InternalError);
}

TEST(CowArray, CopiesOfEveryAgeStayAsTheyWereUnderRandomEdits) {
  Rng rng(7);
  SmallChunks array;
  std::vector<int> expected;
  std::vector<SmallChunks> copies;
  std::vector<std::vector<int>> contents;
  for (int step = 0; step < 600; ++step) {
    if (expected.empty() || rng.Uniform() < 0.3) {
      array.PushBack(step);
      expected.push_back(step);
    } else if (rng.Uniform() < 0.1) {
      copies.push_back(array.Share());
      contents.push_back(expected);
    } else {
      const auto i = rng.Index(expected.size());
      array.Edit(i) = -step;
      expected[i] = -step;
    }
  }
  EXPECT_EQ(Contents(array), expected);
  ASSERT_GT(copies.size(), 10U);
  for (std::size_t c = 0; c < copies.size(); ++c)
    EXPECT_EQ(Contents(copies[c]), contents[c]) << "copy " << c;
}

// ThreadSanitizer watches this one: the reader reads and drops a copy while the owner edits.
TEST(CowArray, CopyCanBeReadAndDroppedWhileOwnerEdits) {
  SmallChunks array = MakeArray(400);
  for (int round = 0; round < 20; ++round) {
    std::int64_t sum = 0;
    std::thread reader([copy = array.Share(), &sum]() mutable {
      for (std::size_t i = 0; i < copy.size(); ++i)
        sum += copy[i];
      copy = SmallChunks();
    });
    std::int64_t expected = 0;
    for (std::size_t i = 0; i < 400; ++i) {
      expected += array[i];
      ++array.Edit(i);
    }
    reader.join();
    EXPECT_EQ(sum, expected) << "round " << round;
  }
}

}  // namespace
}  // namespace cslam
