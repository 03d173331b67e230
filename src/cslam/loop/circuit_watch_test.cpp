// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/loop/circuit_watch.h"

#include "cslam/loop/place_stage.h"
#include "cslam/map/test_map.h"
#include "cslam/map/test_room.h"

#include <gtest/gtest.h>

#include <vector>

namespace cslam {
namespace {

constexpr int kNumFeatures = 400;
constexpr int kEnough = 20;  // shared points

class CircuitWatchTest : public testing::Test {
 protected:
  // A keyframe that shares points with those of the given numbers. Says whether it closes a
  // circuit.
  bool Add(const std::vector<std::uint32_t>& seen_with, int num_shared = kEnough) {
    const auto id = static_cast<std::uint32_t>(map_.num_keyframe_ids());
    map_.AddKeyframe(test::MakeKeyframe(id, kNumFeatures, 0.1 * id, newest_));
    newest_ = KeyframeId(id);
    used_.push_back(0);
    for (const std::uint32_t other : seen_with) {
      for (int i = 0; i < num_shared; ++i) {
        const PointId point = map_.AddPoint({0.1 * id, 0.0, 3.0}, newest_);
        map_.AddObservation(point, newest_, used_[id]++);
        map_.AddObservation(point, KeyframeId(other), used_[other]++);
      }
    }
    return watch_.IsClosedBy(*map_.FindKeyframe(newest_), map_);
  }
  // Keyframes that share points with the one before only. How many of them close a circuit?
  int GoOn(int count) {
    int num_closing = 0;
    for (int i = 0; i < count; ++i) {
      const auto before = static_cast<std::uint32_t>(map_.num_keyframe_ids()) - 1;
      num_closing += Add({before}) ? 1 : 0;
    }
    return num_closing;
  }
  std::uint32_t Newest() const { return newest_.value(); }

  Map map_{test::kLevelScales};
  CircuitWatch watch_{CircuitOptions{}};

 private:
  KeyframeId newest_;
  std::vector<int> used_;  // keypoints, by keyframe
};

TEST_F(CircuitWatchTest, IsClosedOnceByTheThirdKeyframeThatIsBack) {
  Add({});
  EXPECT_EQ(GoOn(14), 0);
  EXPECT_FALSE(Add({0, Newest()}));
  EXPECT_FALSE(Add({0, 1, Newest()}));
  EXPECT_TRUE(Add({1, Newest()}));
  EXPECT_FALSE(Add({2, Newest()}));
  EXPECT_FALSE(Add({2, Newest()}));
  EXPECT_FALSE(Add({3, Newest()}));
}

TEST_F(CircuitWatchTest, IsClosedAgainByTheNextWayRound) {
  Add({});
  GoOn(14);
  for (int i = 0; i < 3; ++i)
    Add({0, Newest()});
  EXPECT_EQ(GoOn(12), 0);
  EXPECT_FALSE(Add({0, Newest()}));
  EXPECT_FALSE(Add({0, Newest()}));
  EXPECT_TRUE(Add({0, Newest()}));
}

TEST_F(CircuitWatchTest, IsNoneWhereTheWayIsShort) {
  Add({});
  GoOn(6);
  for (int i = 0; i < 5; ++i)
    EXPECT_FALSE(Add({0, Newest()}));
}

TEST_F(CircuitWatchTest, IsNoneWhileTheBeginningNeverLeavesThePicture) {
  Add({});
  std::vector<std::uint32_t> all{0};
  for (std::uint32_t i = 1; i < 25; ++i) {
    EXPECT_FALSE(Add(all, 15));
    all.push_back(i);
  }
}

TEST_F(CircuitWatchTest, IsNoneForManyShortWays) {
  Add({});
  GoOn(14);
  for (int i = 0; i < 3; ++i)
    Add({0, Newest()});
  for (int way = 0; way < 5; ++way) {
    EXPECT_EQ(GoOn(6), 0);
    for (int i = 0; i < 3; ++i)
      EXPECT_FALSE(Add({0, Newest()}));
  }
}

TEST_F(CircuitWatchTest, TakesALongerWayInALargeMap) {
  Add({});
  GoOn(199);
  for (int i = 0; i < 3; ++i)
    Add({0, Newest()});
  GoOn(15);
  for (int i = 0; i < 3; ++i)
    EXPECT_FALSE(Add({1, Newest()})) << "less than a tenth of the map";
  GoOn(25);
  EXPECT_FALSE(Add({1, Newest()}));
  EXPECT_FALSE(Add({1, Newest()}));
  EXPECT_TRUE(Add({1, Newest()}));
}

TEST_F(CircuitWatchTest, IsNoneForAFewPointsThatAreSharedByChance) {
  Add({});
  GoOn(14);
  for (int i = 0; i < 5; ++i)
    EXPECT_FALSE(Add({0, Newest()}, 5));
}

TEST_F(CircuitWatchTest, IsNoneWhereARunBeginsInTheMapOfAnEarlierOne) {
  Add({});
  GoOn(14);
  watch_.Reset();
  EXPECT_FALSE(Add({2}));
  for (int i = 0; i < 5; ++i)
    EXPECT_FALSE(Add({3, Newest()}));
}

TEST_F(CircuitWatchTest, IsNoneIfTurnedOff) {
  CircuitOptions options;
  options.enabled = false;
  watch_ = CircuitWatch(options);
  Add({});
  GoOn(14);
  for (int i = 0; i < 5; ++i)
    EXPECT_FALSE(Add({0, Newest()}));
}

TEST_F(CircuitWatchTest, IsToldByThePlaceStage) {
  PlaceStage places(test::RoomCamera(), {}, {}, {});
  Add({});
  GoOn(14);
  for (int i = 0; i < 3; ++i)
    Add({0, Newest()});
  MapSnapshot snapshot;
  snapshot.map = map_.Snapshot();
  std::vector<KeyframeId> closing;
  for (const KeyframeId id : snapshot.map.Keyframes()) {
    if (places.OnKeyframe(id, snapshot).closes_circuit) closing.push_back(id);
  }
  EXPECT_EQ(closing, std::vector{KeyframeId(17)});
}

}  // namespace
}  // namespace cslam
