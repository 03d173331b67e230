// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// What breaks: no depth, false detections, flickering names, mirrors, carried things, clocks.
#include "cslam/mapping/object_layer.h"
#include "cslam/mapping/test_object_layer.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

using test::kCouchClass;
using test::kPlace;
using test::kTableClass;
using test::ObjectLayerTest;
using test::PoseLookingAt;

TEST_F(ObjectLayerTest, MakesNoObjectsWithoutDepth) {
  room_.things = {Chair(kPlace)};
  test::ThingView seen = test::LookAtThings(room_, camera_, front_, now_);
  seen.view.depth_mm.setTo(0);
  KeyframeProposal blind;
  blind.objects = {seen.view, seen.sightings, {}};
  EXPECT_EQ(Insert(front_, blind).num_new, 0);
  blind.objects = {DepthView{}, seen.sightings, {}};
  EXPECT_EQ(Insert(front_, blind).num_new, 0);
  EXPECT_TRUE(map_.Objects().empty());
}

TEST_F(ObjectLayerTest, KeepsWhatItKnowsWhileDepthIsGone) {
  room_.things = {Chair(kPlace)};
  Watch(front_, 4);
  const double belief = BeliefOf(Object(0));
  test::ThingView seen = test::LookAtThings(room_, camera_, front_, now_);
  seen.view.depth_mm.setTo(0);
  for (int i = 0; i < 5; ++i) {
    KeyframeProposal blind;
    blind.objects = {seen.view, seen.sightings, {}};
    Insert(front_, blind);
  }
  EXPECT_EQ(Present(), std::vector{ObjectId(0)});
  EXPECT_EQ(BeliefOf(Object(0)), belief);
  EXPECT_EQ(Object(0).num_sightings, 4);
  Watch(front_, 1);
  EXPECT_EQ(map_.Objects().size(), 1U) << "it is the same chair afterwards";
}

TEST_F(ObjectLayerTest, SurvivesAThousandFalseDetections) {
  Rng rng(3);
  const auto noise = [&](const DepthView& view, std::uint32_t first_track) {
    std::vector<ObjectSighting> sightings;
    for (std::uint32_t i = 0; i < 1000; ++i) {
      ObjectSighting sighting;
      sighting.track = TrackId(first_track + i);
      sighting.class_id = static_cast<int>(rng.Index(kNumCocoClasses));
      sighting.score = rng.Uniform(0.3, 1.0);
      cv::Mat mask = cv::Mat::zeros(view.depth_mm.size(), CV_8UC1);
      const auto u = static_cast<int>(rng.Index(140));
      const auto v = static_cast<int>(rng.Index(100));
      mask(cv::Rect(u, v, 20, 20)).setTo(255);
      sighting.region = test::RegionOf(view, mask);
      sighting.box = sighting.region.box;
      sighting.first_detected = sighting.detected = now_;
      sightings.push_back(std::move(sighting));
    }
    return sightings;
  };
  room_.things = {Chair(kPlace)};
  const DepthView view = test::LookAtThings(room_, camera_, front_, now_).view;
  for (std::uint32_t i = 0; i < 2; ++i) {
    KeyframeProposal proposal;
    proposal.objects = {view, noise(view, 1000 * i), {}};
    EXPECT_LE(Insert(front_, proposal).num_new, 64) << "the surest of each keyframe";
  }
  EXPECT_TRUE(Present().empty()) << "nobody saw any of it again";
  EXPECT_TRUE(map_.changes().empty());
}

TEST_F(ObjectLayerTest, IsOneObjectWhenNamesFlicker) {
  room_.things = {Chair(kPlace)};
  const std::vector<int> names{kChairClass, kCouchClass, kChairClass, kTableClass, kChairClass};
  for (std::size_t i = 0; i < names.size(); ++i) {
    room_.things[0].class_id = names[i];
    room_.things[0].track = TrackId(static_cast<std::uint32_t>(i));
    Insert(front_);
  }
  ASSERT_EQ(map_.Objects().size(), 1U);
  EXPECT_EQ(Object(0).class_id, kChairClass) << "the name it has most often";
  EXPECT_EQ(Object(0).votes.size(), 3U);
  EXPECT_EQ(Object(0).num_sightings, 5);
}

TEST_F(ObjectLayerTest, BelievesInAThingWhoseNameFlickers) {
  room_.things = {Chair(kPlace)};
  for (int i = 0; i < 12; ++i) {
    room_.things[0].class_id = i % 2 == 0 ? kChairClass : kCouchClass;
    Watch(front_, 1);
  }
  EXPECT_EQ(Present(), std::vector{ObjectId(0)});
  EXPECT_EQ(Object(0).num_sightings, 12);
  EXPECT_EQ(map_.Objects().size(), 1U);
  EXPECT_TRUE(map_.changes().empty()) << "a couch that replaces a chair is no flicker";
}

// The tracker tells no sighting of what it sees moving.
TEST_F(ObjectLayerTest, LeavesNoTrailOfAThingThatIsCarriedThroughView) {
  constexpr int kSteps = 40;
  const Eigen::Vector3d from(-1.0, 0.2, 2.2);
  const Eigen::Vector3d to(1.0, 0.2, 2.2);
  room_.things = {Chair(from)};
  Watch(front_, 5);
  for (int i = 1; i <= kSteps; ++i) {
    room_.things[0] = Chair(from + (to - from) * i / kSteps);
    room_.things[0].is_detected = i == kSteps;
    Watch(front_, 1);
  }
  Watch(front_, 5);
  ASSERT_EQ(Present(), std::vector{ObjectId(1)});
  EXPECT_LT((map_.CentroidOf(Object(1)) - to).head<2>().norm(), 0.1);
  ASSERT_EQ(map_.changes().size(), 1U);
  EXPECT_EQ(map_.changes()[0].kind, MapChangeKind::kMoved);
}

// A sighting at every step lies on the surface of the last one. That leaves a trail, which goes.
TEST_F(ObjectLayerTest, FindsAThingThatMovedTooSlowlyToBeSeenMoving) {
  constexpr int kSteps = 20;  // 10 cm each
  const Eigen::Vector3d from(-1.0, 0.2, 2.2);
  const Eigen::Vector3d to(1.0, 0.2, 2.2);
  room_.things = {Chair(from)};
  Watch(front_, 5);
  for (int i = 1; i <= kSteps; ++i) {
    room_.things[0] = Chair(from + (to - from) * i / kSteps);
    Watch(front_, 1);
  }
  Watch(front_, 10);
  ASSERT_EQ(Present().size(), 1U);
  EXPECT_LT((map_.CentroidOf(*map_.FindObject(Present()[0])) - to).head<2>().norm(), 0.2);
  ASSERT_FALSE(map_.changes().empty());
  for (const MapChange& change : map_.changes())
    EXPECT_EQ(change.kind, MapChangeKind::kMoved);
  EXPECT_EQ(map_.changes().back().new_object, Present()[0]);
}

TEST_F(ObjectLayerTest, IsOneObjectWhenDetectedTwiceInEachPicture) {
  room_.things = {Chair(kPlace, 1), Chair(kPlace, 2)};
  Watch(front_, 4);
  EXPECT_EQ(map_.Objects(), std::vector{ObjectId(0)});
  EXPECT_TRUE(map_.changes().empty());
}

// Depth cameras see it behind the mirror, as good as any thing; it moves with the thing.
TEST_F(ObjectLayerTest, KeepsAThingAndItsMirrorImageApart) {
  const auto put = [&](double distance_m) {
    room_.things = {Chair({-distance_m, 0.2, 2.2}, 1), Chair({distance_m, 0.2, 2.2}, 2)};
  };
  put(1.0);
  Watch(front_, 5);
  ASSERT_EQ(Present().size(), 2U);
  room_.things.pop_back();  // one looks into the mirror no more
  Watch(front_, 5);
  EXPECT_EQ(Present(), std::vector{ObjectId(0)});
  ASSERT_EQ(map_.changes().size(), 1U);
  EXPECT_EQ(map_.changes()[0].kind, MapChangeKind::kRemoved);
  EXPECT_EQ(map_.changes()[0].object, ObjectId(1)) << "it has not become the other one";
  put(1.0);
  Watch(front_, 5);
  EXPECT_EQ(Present(), (std::vector{ObjectId(0), ObjectId(1)})) << "back as what it was";
}

TEST_F(ObjectLayerTest, TellsEachMoveOfAThingAndItsMirrorImageOnce) {
  room_.things = {Chair({-1.0, 0.2, 2.2}, 1), Chair({1.0, 0.2, 2.2}, 2)};
  Watch(front_, 5);
  room_.things = {Chair({-0.3, 0.2, 2.2}, 3), Chair({0.3, 0.2, 2.2}, 4)};
  Watch(front_, 8);
  EXPECT_EQ(Present().size(), 2U);
  std::vector<ObjectId> named;
  for (const MapChange& change : map_.changes()) {
    EXPECT_EQ(change.kind, MapChangeKind::kMoved);
    named.push_back(change.object);
    named.push_back(change.new_object);
  }
  std::ranges::sort(named);
  EXPECT_EQ(named, map_.Objects()) << "two pairs of two";
}

TEST_F(ObjectLayerTest, TakesAClockThatJumpsAhead) {
  constexpr std::int64_t kYearNs = 31'536'000'000'000'000LL;
  room_.things = {Chair(kPlace)};
  Watch(front_, 4);
  const double belief = BeliefOf(Object(0));
  now_ = now_ + kYearNs;
  Insert(front_);
  EXPECT_EQ(Present(), std::vector{ObjectId(0)});
  EXPECT_EQ(BeliefOf(Object(0)), belief) << "time alone says nothing";
  room_.things.clear();
  Watch(front_, 1);
  now_ = now_ + kYearNs;
  Watch(front_, 4);
  EXPECT_EQ(Object(0).state, ObjectState::kAbsent);
  EXPECT_EQ(map_.changes().size(), 1U);
}

TEST_F(ObjectLayerTest, TakesAClockThatJumpsBack) {
  room_.things = {Chair(kPlace)};
  Settle(front_);
  now_ = Stamp{5};
  room_.things.clear();
  Insert(front_, std::vector{Through(ObjectId(0), 4)});
  EXPECT_EQ(Object(0).state, ObjectState::kAbsent);
  ASSERT_EQ(map_.changes().size(), 1U);
  EXPECT_EQ(map_.changes()[0].kind, MapChangeKind::kRemoved);
  room_.things = {Chair({2.0, 0.2, 0.0}, 7)};
  Settle(PoseLookingAt({0.0, 0.2, 0.0}, {2.0, 0.2, 0.0}));
  ASSERT_EQ(map_.changes().size(), 1U);
  EXPECT_EQ(map_.changes()[0].kind, MapChangeKind::kMoved);
}

}  // namespace
}  // namespace cslam
