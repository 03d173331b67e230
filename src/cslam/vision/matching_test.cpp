// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/vision/matching.h"

#include "cslam/util/check.h"
#include "cslam/vision/test_features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>

namespace cslam {

// Where GoogleTest finds it: comparing and printing matches.
static bool operator==(const Match& a, const Match& b) {
  return a.query == b.query && a.keypoint == b.keypoint && a.distance == b.distance;
}
static void PrintTo(const Match& match, std::ostream* stream) {
  *stream << match.query << "->" << match.keypoint << " (" << match.distance << ")";
}

namespace {

using test::FirstBits;
using test::MakeFeatures;
using Matches = std::vector<Match>;

ProjectionQuery QueryAt(float u, float v, float radius_px, const Descriptor& descriptor = {}) {
  ProjectionQuery query;
  query.uv_px = {u, v};
  query.radius_px = radius_px;
  query.descriptor = descriptor;
  return query;
}

Matches MatchOne(const FrameFeatures& features, const ProjectionQuery& query,
                 const MatchOptions& options = {}) {
  return MatchByProjection(features, std::vector{query}, options);
}

std::vector<int> All(const FrameFeatures& features) {
  std::vector<int> indices(features.size());
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

TEST(MatchByProjection, TakesTheBestDescriptorInsideTheRadius) {
  const auto features = MakeFeatures({{.u = 100, .v = 100, .descriptor = FirstBits(20)},
                                      {.u = 105, .v = 100, .descriptor = FirstBits(10)},
                                      {.u = 120, .v = 100, .descriptor = FirstBits(0)}});
  EXPECT_EQ(MatchOne(features, QueryAt(100, 100, 8)), (Matches{{0, 1, 10}}));
}

TEST(MatchByProjection, SearchesASquareOfTheRadiusAcrossCells) {
  const auto features = MakeFeatures({{.u = 60, .v = 60}});
  EXPECT_EQ(MatchOne(features, QueryAt(40, 79, 20)).size(), 1U);
  EXPECT_TRUE(MatchOne(features, QueryAt(39.5F, 60, 20)).empty());
  EXPECT_TRUE(MatchOne(features, QueryAt(60, 80.5F, 20)).empty());
}

TEST(MatchByProjection, FindsKeypointsAtTheImageBorderFromOutside) {
  const auto features = MakeFeatures({{.u = 0, .v = 0}, {.u = 639, .v = 479}});
  EXPECT_EQ(MatchOne(features, QueryAt(-3, -3, 5)), (Matches{{0, 0, 0}}));
  EXPECT_EQ(MatchOne(features, QueryAt(643, 483, 5)), (Matches{{0, 1, 0}}));
}

TEST(MatchByProjection, KeepsToTheOctavesAsked) {
  const auto features = MakeFeatures({{.u = 100, .v = 100, .octave = 1},
                                      {.u = 101, .v = 100, .octave = 2},
                                      {.u = 102, .v = 100, .octave = 4}});
  ProjectionQuery query = QueryAt(100, 100, 10);
  query.min_octave = 2;
  query.max_octave = 3;
  EXPECT_EQ(MatchOne(features, query), (Matches{{0, 1, 0}}));
  query.min_octave = 3;
  EXPECT_TRUE(MatchOne(features, query).empty());
}

TEST(MatchByProjection, RefusesDescriptorsThatDifferTooMuch) {
  const auto features = MakeFeatures({{.u = 100, .v = 100, .descriptor = FirstBits(51)}});
  EXPECT_EQ(MatchOne(features, QueryAt(100, 100, 5), {.max_distance = 51}).size(), 1U);
  EXPECT_TRUE(MatchOne(features, QueryAt(100, 100, 5), {.max_distance = 50}).empty());
}

TEST(MatchByProjection, RefusesAnAmbiguousBest) {
  const auto features = MakeFeatures({{.u = 100, .v = 100, .descriptor = FirstBits(20)},
                                      {.u = 105, .v = 100, .descriptor = FirstBits(22)}});
  EXPECT_TRUE(MatchOne(features, QueryAt(100, 100, 10), {.max_ratio = 0.9}).empty());
  EXPECT_EQ(MatchOne(features, QueryAt(100, 100, 10), {.max_ratio = 0.95}).size(), 1U);
}

TEST(MatchByProjection, DoesNotCallASecondAtAnotherScaleAmbiguous) {
  const auto features =
      MakeFeatures({{.u = 100, .v = 100, .descriptor = FirstBits(20)},
                    {.u = 105, .v = 100, .descriptor = FirstBits(22), .octave = 1}});
  EXPECT_EQ(MatchOne(features, QueryAt(100, 100, 10), {.max_ratio = 0.5}), (Matches{{0, 0, 20}}));
}

TEST(MatchByProjection, GivesAKeypointToTheNearestQueryOnly) {
  const auto features = MakeFeatures({{.u = 100, .v = 100, .descriptor = FirstBits(10)}});
  const std::vector queries{QueryAt(100, 100, 5, FirstBits(30)),
                            QueryAt(101, 100, 5, FirstBits(12)),
                            QueryAt(102, 100, 5, FirstBits(0))};
  EXPECT_EQ(MatchByProjection(features, queries, {}), (Matches{{1, 0, 2}}));
}

TEST(MatchByProjection, GivesAKeypointToTheFirstOfEqualQueries) {
  const auto features = MakeFeatures({{.u = 100, .v = 100}});
  const std::vector queries{QueryAt(103, 100, 5), QueryAt(100, 100, 5)};
  EXPECT_EQ(MatchByProjection(features, queries, {}), (Matches{{0, 0, 0}}));
}

TEST(MatchByProjection, TakesTheFirstOfEqualKeypointsEveryTime) {
  const auto features = MakeFeatures({{.u = 104, .v = 100}, {.u = 100, .v = 100}});
  EXPECT_EQ(MatchOne(features, QueryAt(100, 100, 5)), (Matches{{0, 0, 0}}));
}

TEST(MatchByProjection, LeavesTakenKeypointsAlone) {
  const auto features =
      MakeFeatures({{.u = 100, .v = 100}, {.u = 105, .v = 100, .descriptor = FirstBits(9)}});
  const std::vector<std::uint8_t> is_taken{1, 0};
  const auto matches =
      MatchByProjection(features, std::vector{QueryAt(100, 100, 10)}, {}, is_taken);
  EXPECT_EQ(matches, (Matches{{0, 1, 9}}));
}

TEST(MatchByProjection, ComparesRightCoordinatesWhereBothHaveDepth) {
  const auto features = MakeFeatures({{.u = 100, .v = 100, .disparity_px = 30.0F},
                                      {.u = 101, .v = 100, .descriptor = FirstBits(5)}});
  ProjectionQuery query = QueryAt(100, 100, 5);
  query.disparity_px = 20.0F;
  EXPECT_EQ(MatchOne(features, query), (Matches{{0, 1, 5}})) << "10 px off on the right";
  query.disparity_px = 26.0F;
  EXPECT_EQ(MatchOne(features, query), (Matches{{0, 0, 0}}));
}

TEST(MatchByProjection, FindsNothingAmongNoKeypoints) {
  EXPECT_TRUE(MatchOne(FrameFeatures{}, QueryAt(100, 100, 50)).empty());
  EXPECT_TRUE(MatchByProjection(MakeFeatures({{}}), {}, {.check_rotation = true}).empty());
}

// Ten features of different looks, all turned by rotation_rad but for number odd_one.
struct TurnedPair {
  FrameFeatures features;
  std::vector<ProjectionQuery> queries;
};
TurnedPair MakeTurnedPair(float rotation_rad, std::size_t odd_one, float odd_rotation_rad) {
  Rng rng(3);
  TurnedPair pair;
  std::vector<test::Feature> features;
  for (std::size_t i = 0; i < 21; ++i) {
    const float u = 20.0F * static_cast<float>(i + 1);
    const Descriptor descriptor = test::RandomDescriptor(rng);
    const float angle = 0.29F * static_cast<float>(i);
    features.push_back({.u = u, .v = 100, .descriptor = descriptor, .angle_rad = angle});
    pair.queries.push_back(QueryAt(u, 100, 5, descriptor));
    pair.queries.back().angle_rad = angle + (i == odd_one ? odd_rotation_rad : rotation_rad);
  }
  pair.features = MakeFeatures(features);
  return pair;
}

TEST(MatchByProjection, DropsTheOneThatTurnedAgainstTheMajority) {
  const TurnedPair pair = MakeTurnedPair(0.42F, 4, 2.5F);
  const auto all = MatchByProjection(pair.features, pair.queries, {});
  const auto kept = MatchByProjection(pair.features, pair.queries, {.check_rotation = true});
  EXPECT_EQ(all.size(), 21U);
  EXPECT_EQ(kept.size(), 20U);
  EXPECT_TRUE(std::none_of(kept.begin(), kept.end(), [](const Match& m) { return m.query == 4; }));
}

TEST(MatchByProjection, RotationsAFullTurnApartAreTheSame) {
  const auto full_turn = static_cast<float>(2.0 * std::numbers::pi);
  const TurnedPair pair = MakeTurnedPair(0.42F, 4, 0.42F - full_turn);
  EXPECT_EQ(MatchByProjection(pair.features, pair.queries, {.check_rotation = true}).size(), 21U);
}

TEST(MatchByDescriptor, FindsWhatLooksAlikeWhereverItIs) {
  Rng rng(1);
  const Descriptor red = test::RandomDescriptor(rng);
  const Descriptor blue = test::RandomDescriptor(rng);
  const auto a = MakeFeatures({{.u = 10, .descriptor = red}, {.u = 20, .descriptor = blue}});
  const auto b = MakeFeatures({{.u = 600, .descriptor = blue}, {.v = 400, .descriptor = red}});
  EXPECT_EQ(MatchByDescriptor(a, All(a), b, All(b), {}), (Matches{{0, 1, 0}, {1, 0, 0}}));
}

TEST(MatchByDescriptor, WantsTheBestOfBothSides) {
  const auto a = MakeFeatures({{.descriptor = FirstBits(10)}, {.descriptor = FirstBits(4)}});
  const auto b = MakeFeatures({{.descriptor = FirstBits(0)}});
  EXPECT_EQ(MatchByDescriptor(a, All(a), b, All(b), {}), (Matches{{1, 0, 4}}));
}

TEST(MatchByDescriptor, LooksAtTheListedOnly) {
  const auto a = MakeFeatures({{.descriptor = FirstBits(3)}, {.descriptor = FirstBits(9)}});
  const auto b = MakeFeatures({{.descriptor = FirstBits(3)}, {.descriptor = FirstBits(9)}});
  EXPECT_EQ(MatchByDescriptor(a, std::vector{1}, b, std::vector{0}, {}), (Matches{{1, 0, 6}}));
  EXPECT_TRUE(MatchByDescriptor(a, {}, b, All(b), {.check_rotation = true}).empty());
  EXPECT_TRUE(MatchByDescriptor(a, All(a), b, {}, {.check_rotation = true}).empty());
}

TEST(MatchByDescriptor, RefusesTheFarAndTheAmbiguous) {
  const auto a = MakeFeatures({{.descriptor = FirstBits(0)}});
  const auto b = MakeFeatures({{.descriptor = FirstBits(40)}, {.descriptor = FirstBits(50)}});
  EXPECT_EQ(MatchByDescriptor(a, All(a), b, All(b), {}).size(), 1U);
  EXPECT_TRUE(MatchByDescriptor(a, All(a), b, All(b), {.max_distance = 39}).empty());
  EXPECT_TRUE(MatchByDescriptor(a, All(a), b, All(b), {.max_ratio = 0.7}).empty());
}

TEST(MedoidIndex, IsTheOneInTheMiddle) {
  const std::vector descriptors{FirstBits(90), FirstBits(10), FirstBits(0), FirstBits(20)};
  EXPECT_EQ(MedoidIndex(descriptors), 1U);
}

TEST(MedoidIndex, IsTheFirstOfEquals) {
  EXPECT_EQ(MedoidIndex(std::vector{FirstBits(5)}), 0U);
  EXPECT_EQ(MedoidIndex(std::vector{FirstBits(5), FirstBits(9)}), 0U);
  EXPECT_THROW(MedoidIndex({}), InternalError);
}

}  // namespace
}  // namespace cslam
