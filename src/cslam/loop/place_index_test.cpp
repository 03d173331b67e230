// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/place_index.h"

#include "cslam/map/test_map.h"
#include "cslam/util/check.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace cslam {
namespace {

std::vector<Descriptor> RandomDescriptors(std::uint64_t seed, int count) {
  Rng rng(seed, 5);
  std::vector<Descriptor> descriptors;
  for (int i = 0; i < count; ++i)
    descriptors.push_back(test::RandomDescriptor(rng));
  return descriptors;
}

// As another view sees them: every bit is flipped with a probability of one in ten.
std::vector<Descriptor> SeenAgain(std::vector<Descriptor> descriptors, std::uint64_t seed) {
  Rng rng(seed, 6);
  for (Descriptor& descriptor : descriptors) {
    for (std::size_t bit = 0; bit < 256; ++bit) {
      if (rng.Uniform() < 0.1) descriptor.words[bit / 64] ^= std::uint64_t{1} << (bit % 64);
    }
  }
  return descriptors;
}

PlaceIndex IndexOf(int num_places) {
  PlaceIndex index;
  for (int i = 0; i < num_places; ++i) {
    index.Add(KeyframeId(static_cast<std::uint32_t>(i)),
              RandomDescriptors(static_cast<std::uint64_t>(i), 100));
  }
  return index;
}

TEST(PlaceIndex, RanksThePlaceSeenAgainFirst) {
  const PlaceIndex index = IndexOf(50);
  for (std::uint32_t place = 0; place < 50; ++place) {
    const auto candidates = index.Query(SeenAgain(RandomDescriptors(place, 100), 9), {}, 5);
    ASSERT_FALSE(candidates.empty());
    EXPECT_EQ(candidates.front().keyframe, KeyframeId(place));
    EXPECT_GT(candidates.front().votes, 25);
  }
}

TEST(PlaceIndex, FindsNothingWhenThePlaceIsUnknown) {
  const PlaceIndex index = IndexOf(50);
  for (const PlaceCandidate& candidate : index.Query(RandomDescriptors(1000, 100), {}, 5))
    EXPECT_LE(candidate.votes, 1);
}

TEST(PlaceIndex, ReturnsNothingWhenEmpty) {
  EXPECT_TRUE(PlaceIndex().Query(RandomDescriptors(1, 10), {}, 5).empty());
}

TEST(PlaceIndex, LeavesOutWhatIsExcluded) {
  const PlaceIndex index = IndexOf(5);
  const auto is_excluded = [](KeyframeId id) { return id == KeyframeId(3); };
  for (const auto& candidate : index.Query(RandomDescriptors(3, 100), is_excluded, 5))
    EXPECT_NE(candidate.keyframe, KeyframeId(3));
}

TEST(PlaceIndex, ForgetsAKeyframeWhenItIsRemoved) {
  PlaceIndex index = IndexOf(5);
  index.Remove(KeyframeId(2));
  EXPECT_FALSE(index.Contains(KeyframeId(2)));
  EXPECT_EQ(index.num_keyframes(), 4U);
  for (const auto& candidate : index.Query(RandomDescriptors(2, 100), {}, 5))
    EXPECT_NE(candidate.keyframe, KeyframeId(2));
  index.Remove(KeyframeId(2));
  index.Remove(KeyframeId(77));
  EXPECT_EQ(index.num_keyframes(), 4U);
}

TEST(PlaceIndex, ReplacesAKeyframeThatIsAddedAgain) {
  PlaceIndex index = IndexOf(3);
  index.Add(KeyframeId(1), RandomDescriptors(40, 100));
  EXPECT_EQ(index.num_keyframes(), 3U);
  EXPECT_EQ(index.Query(RandomDescriptors(40, 100), {}, 1).front().votes, 100);
  EXPECT_TRUE(index.Query(RandomDescriptors(1, 100), {}, 1).empty());
}

TEST(PlaceIndex, AnswersTheSameWhateverTheOrderOfInsertion) {
  PlaceIndex backwards;
  for (std::uint32_t i = 30; i-- > 0;)
    backwards.Add(KeyframeId(i), RandomDescriptors(i, 100));
  const PlaceIndex forwards = IndexOf(30);
  const auto query = SeenAgain(RandomDescriptors(7, 100), 2);
  const auto a = forwards.Query(query, {}, 30);
  const auto b = backwards.Query(query, {}, 30);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].keyframe, b[i].keyframe);
    EXPECT_EQ(a[i].score, b[i].score);
  }
}

TEST(PlaceIndex, CountsAFeatureThatIsEverywhereForLess) {
  const std::vector<Descriptor> common = RandomDescriptors(100, 20);
  const std::vector<Descriptor> rare = RandomDescriptors(200, 20);
  PlaceIndex index;
  for (std::uint32_t i = 0; i < 20; ++i)
    index.Add(KeyframeId(i), i == 13 ? rare : common);
  std::vector<Descriptor> query = common;
  query.insert(query.end(), rare.begin(), rare.end());
  EXPECT_EQ(index.Query(query, {}, 1).front().keyframe, KeyframeId(13));
}

TEST(PlaceIndex, RefusesMoreBitsThanADescriptorHas) {
  EXPECT_THROW(PlaceIndex({.num_tables = 12, .key_bits = 17}), InternalError);
}

TEST(PlaceKeypoints, LeavesOutPeopleAndThingsThatMayBeMoved) {
  FrameFeatures features = test::MakeFeatures(std::vector<test::Feature>(3));
  features.semantics[0].label = KeypointLabel::kDynamic;
  features.semantics[2].label = KeypointLabel::kMovable;
  EXPECT_EQ(PlaceKeypoints(features), std::vector<int>{1});
}

TEST(PlaceKeypoints, TakesTheKeypointsOfAKeyframeThatHaveAPoint) {
  Map map(test::kLevelScales);
  map.AddKeyframe(test::MakeKeyframe(0, 10));
  map.AddObservation(map.AddPoint({0.0, 0.0, 1.0}, KeyframeId(0)), KeyframeId(0), 4);
  EXPECT_EQ(PlaceKeypoints(map, *map.FindKeyframe(KeyframeId(0))), std::vector<int>{4});
}

}  // namespace
}  // namespace cslam
