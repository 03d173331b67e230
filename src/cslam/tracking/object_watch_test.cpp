// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/tracking/object_watch.h"

#include "cslam/map/test_map.h"
#include "cslam/objects/test_depth.h"
#include "cslam/semantics/coco.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

using test::DrawPanel;
using test::ViewOf;
using test::Wall;

constexpr int kCouchClass = 57;
constexpr int kBearClass = 77;
constexpr double kDepthM = 2.0;
const ObjectId kChair(0);

// A chair that the map believes in, 2 m in front of a camera at the origin, the wall at 4 m.
class ObjectWatchTest : public testing::Test {
 protected:
  ObjectWatchTest() : map_(test::kLevelScales) {
    map_.AddKeyframe(test::MakeKeyframe(0, 0));
    ObjectSurface surface;
    for (float y = -0.27F; y < 0.28F; y += 0.06F) {
      for (float x = -0.27F; x < 0.28F; x += 0.06F)
        surface.samples.emplace_back(x, y, static_cast<float>(kDepthM));
    }
    MapObject chair;
    chair.map = MapId(0);
    chair.class_id = kChairClass;
    chair.reference = KeyframeId(0);
    chair.surface = std::make_shared<const ObjectSurface>(std::move(surface));
    chair.centroid = {0.0, 0.0, kDepthM};
    chair.state = ObjectState::kPresent;
    chair.log_odds = LogOdds(0.9);
    map_.AddObject(std::move(chair));
  }

  static cv::Mat WithPanel(double depth, double width = 0.6) {
    cv::Mat depth_m = Wall(4.0);
    DrawPanel(depth_m, 0.0, 0.0, depth, width, width);
    return depth_m;
  }
  static ObjectSighting SightingAt(double depth, int class_id, Stamp detected) {
    ObjectSighting sighting;
    sighting.track = TrackId(4);
    sighting.class_id = class_id;
    sighting.score = 0.7;
    sighting.region.mask = cv::Mat::zeros(120, 160, CV_8UC1);
    sighting.region.mask(cv::Rect(60, 40, 40, 40)).setTo(255);
    sighting.region.num_pixels = 1600;
    sighting.region.centre_camera = {0.0, 0.0, depth};
    sighting.first_detected = sighting.detected = detected;
    return sighting;
  }
  static Stamp At(double seconds) { return Stamp{static_cast<std::int64_t>(seconds * 1e9)}; }

  void Look(double seconds, const cv::Mat& depth_m, std::vector<ObjectSighting> sightings = {},
            const Se3& T_world_camera = {}) {
    const DepthView view = ViewOf(depth_m);
    WatchedFrame frame;
    frame.stamp = At(seconds);
    frame.map = MapId(0);
    frame.T_world_camera = T_world_camera;
    frame.num_inliers = 400;
    frame.view = &view;
    frame.sightings = sightings;
    frame.detections = At(seconds);
    watch_.Look(frame, map_);
  }
  // The chair's evidence; a default one if there is none.
  ObjectEvidence Taken() {
    for (const ObjectEvidence& evidence : watch_.Take()) {
      if (evidence.object == kChair) return evidence;
    }
    return {};
  }
  void SetState(ObjectState state) {
    MapObject chair = *map_.FindObject(kChair);
    chair.state = state;
    map_.SetObject(std::move(chair));
  }

  Map map_;
  ObjectWatch watch_{ObjectWatchOptions{}};
};

TEST_F(ObjectWatchTest, CountsViewsThatLookThrough) {
  for (int i = 0; i < 3; ++i)
    Look(1.0 + i, Wall(4.0));
  EXPECT_TRUE(watch_.HasNews(map_)) << "told at once, though the camera stands still";
  const ObjectEvidence evidence = Taken();
  EXPECT_EQ(evidence.num_through, 3);
  EXPECT_EQ(evidence.first_through, At(1.0));
  EXPECT_NEAR(evidence.log_ratio, 3.0 * LookedThroughLogRatio({}), 1e-9);
}

TEST_F(ObjectWatchTest, NoticesAbsenceWithinTwoSecondsOfVideo) {
  int frames = 0;
  while (!watch_.HasNews(map_) && frames < 300)
    Look(1.0 + frames++ / 30.0, Wall(4.0));
  EXPECT_LT(frames, 60);
}

TEST_F(ObjectWatchTest, CountsViewsThatAreCloseInTimeOnce) {
  for (int i = 0; i < 5; ++i)
    Look(1.0 + 0.03 * i, Wall(4.0));
  EXPECT_EQ(Taken().num_through, 1);
}

TEST_F(ObjectWatchTest, SaysNothingOfWhatIsOutOfViewHiddenOrWithoutDepth) {
  const Se3 turned(ExpSo3({0.0, 2.0, 0.0}), Eigen::Vector3d::Zero());
  for (int i = 0; i < 5; ++i)
    Look(1.0 + i, Wall(4.0), {}, turned);
  watch_.Clear();
  for (int i = 0; i < 5; ++i)
    Look(11.0 + i, WithPanel(1.0, 1.0));
  for (int i = 0; i < 5; ++i)
    Look(21.0 + i, Wall(0.0));
  for (int i = 0; i < 5; ++i)
    Look(31.0 + i, cv::Mat());
  EXPECT_FALSE(watch_.HasNews(map_));
  EXPECT_TRUE(watch_.Take().empty()) << "unobserved is not absent";
}

TEST_F(ObjectWatchTest, JudgesNothingWhileTheCameraTurnsFast) {
  for (int i = 0; i < 10; ++i) {
    const Se3 turned(ExpSo3({0.0, i % 2 == 0 ? 0.1 : -0.1, 0.0}), Eigen::Vector3d::Zero());
    Look(1.0 + i / 30.0, Wall(4.0), {}, turned);
  }
  EXPECT_LE(Taken().num_through, 1) << "of the first frame no speed is known";
}

TEST_F(ObjectWatchTest, CountsDetectionsAtItsPlace) {
  for (int i = 0; i < 3; ++i)
    Look(1.0 + i, WithPanel(kDepthM), {SightingAt(kDepthM, kChairClass, At(1.0 + i))});
  const ObjectEvidence evidence = Taken();
  EXPECT_EQ(evidence.num_seen, 3);
  EXPECT_GT(evidence.log_ratio, 0.0);
  EXPECT_EQ(evidence.last_seen, At(3.0));
}

TEST_F(ObjectWatchTest, CountsADetectionThatIsCarriedOnOnce) {
  for (int i = 0; i < 3; ++i)
    Look(1.0 + i, WithPanel(kDepthM), {SightingAt(kDepthM, kChairClass, At(1.0))});
  EXPECT_EQ(Taken().num_seen, 1);
}

TEST_F(ObjectWatchTest, TakesAnotherNameOfItForIt) {
  Look(1.0, WithPanel(kDepthM), {SightingAt(kDepthM, kCouchClass, At(1.0))});
  EXPECT_EQ(Taken().num_seen, 1);
}

TEST_F(ObjectWatchTest, DoesNotTakeABearForTheChair) {
  Look(1.0, WithPanel(kDepthM), {SightingAt(kDepthM, kBearClass, At(1.0))});
  EXPECT_EQ(Taken().num_seen, 0);
}

TEST_F(ObjectWatchTest, LooksThroughThoughAnotherChairStandsBehind) {
  for (int i = 0; i < 3; ++i)
    Look(1.0 + i, WithPanel(2.6, 1.2), {SightingAt(2.6, kChairClass, At(1.0 + i))});
  const ObjectEvidence evidence = Taken();
  EXPECT_EQ(evidence.num_seen, 0);
  EXPECT_EQ(evidence.num_through, 3);
}

TEST_F(ObjectWatchTest, HoldsMissingDetectionsAgainstCandidatesOnly) {
  Look(1.0, WithPanel(kDepthM));
  const ObjectEvidence of_present = Taken();
  EXPECT_EQ(of_present.num_missed, 1);
  EXPECT_EQ(of_present.log_ratio, 0.0) << "what is believed in and stands there is there";
  SetState(ObjectState::kCandidate);
  Look(2.0, WithPanel(kDepthM));
  EXPECT_EQ(Taken().num_missed, 1);
}

TEST_F(ObjectWatchTest, CountsAMissWhereWhatStandsThereIsCalledSomethingElse) {
  constexpr int kTeddyBearClass = 77;
  for (int i = 0; i < 3; ++i)
    Look(1.0 + i, WithPanel(kDepthM), {SightingAt(kDepthM, kTeddyBearClass, At(1.0 + i))});
  const ObjectEvidence evidence = Taken();
  EXPECT_EQ(evidence.num_missed, 3);
  EXPECT_EQ(evidence.num_through, 0);
}

TEST_F(ObjectWatchTest, HoldsASightingForOneObjectAlone) {
  MapObject wall = *map_.FindObject(kChair);  // a piece beside it that once passed for a chair
  ObjectSurface surface;
  for (float y = -0.27F; y < 0.28F; y += 0.06F)
    surface.samples.emplace_back(0.5F, y, 4.0F);
  wall.surface = std::make_shared<const ObjectSurface>(std::move(surface));
  wall.centroid = {0.5, 0.0, 2.5};
  wall.state = ObjectState::kCandidate;
  const ObjectId beside = map_.AddObject(std::move(wall));
  Look(1.0, WithPanel(kDepthM), {SightingAt(kDepthM, kChairClass, At(1.0))});
  int num_seen = 0;
  for (const ObjectEvidence& evidence : watch_.Take()) {
    EXPECT_TRUE(evidence.object == kChair || evidence.num_seen == 0) << beside.value();
    num_seen += evidence.num_seen;
  }
  EXPECT_EQ(num_seen, 1);
}

TEST_F(ObjectWatchTest, SaysNothingMoreOfWhatIsKnownToBeAbsent) {
  SetState(ObjectState::kAbsent);
  for (int i = 0; i < 5; ++i)
    Look(1.0 + i, Wall(4.0));
  EXPECT_TRUE(watch_.Take().empty());
}

TEST_F(ObjectWatchTest, SeesThatAnAbsentThingIsBackOnlyOnItsSurface) {
  SetState(ObjectState::kAbsent);
  Look(1.0, WithPanel(1.6), {SightingAt(1.6, kChairClass, At(1.0))});
  EXPECT_EQ(Taken().num_seen, 0) << "a chair in front of the place";
  for (int i = 0; i < 3; ++i)
    Look(2.0 + i, WithPanel(kDepthM), {SightingAt(kDepthM, kChairClass, At(2.0 + i))});
  EXPECT_TRUE(watch_.HasNews(map_));
  EXPECT_EQ(Taken().num_seen, 3);
}

TEST_F(ObjectWatchTest, GoesOnCountingWhenTheClockJumpsBack) {
  Look(100.0, Wall(4.0));
  for (int i = 0; i < 3; ++i)
    Look(1.0 + i, Wall(4.0));
  EXPECT_EQ(Taken().num_through, 4);
}

TEST_F(ObjectWatchTest, TakeLeavesNothingBehind) {
  Look(1.0, Wall(4.0));
  EXPECT_EQ(watch_.Take().size(), 1U);
  EXPECT_TRUE(watch_.Take().empty());
  EXPECT_FALSE(watch_.HasNews(map_));
}

TEST_F(ObjectWatchTest, ForgetsAllWhenCleared) {
  for (int i = 0; i < 3; ++i)
    Look(1.0 + i, Wall(4.0));
  watch_.Clear();
  EXPECT_FALSE(watch_.HasNews(map_));
  EXPECT_TRUE(watch_.Take().empty());
}

TEST_F(ObjectWatchTest, TellsOfNewThingsOnceAndAfterAWhile) {
  ObjectSighting bear = SightingAt(kDepthM, kBearClass, At(1.0));
  Look(1.0, WithPanel(kDepthM), {bear});
  EXPECT_FALSE(watch_.HasNews(map_)) << "it may be a false detection";
  bear.detected = At(1.5);
  Look(1.5, WithPanel(kDepthM), {bear});
  EXPECT_TRUE(watch_.HasNews(map_));
  watch_.Take();
  bear.detected = At(2.0);
  Look(2.0, WithPanel(kDepthM), {bear});
  EXPECT_FALSE(watch_.HasNews(map_));
}

TEST_F(ObjectWatchTest, DoesNotTellOfThingsThatTheMapKnowsOrNeverHolds) {
  for (const int class_id : {kChairClass, kCouchClass, 0}) {
    ObjectSighting sighting = SightingAt(kDepthM, class_id, At(1.5));
    sighting.first_detected = At(1.0);
    Look(1.5, WithPanel(kDepthM), {sighting});
    EXPECT_FALSE(watch_.HasNews(map_)) << class_id;
  }
}

TEST_F(ObjectWatchTest, LeavesObjectsOfOtherMapsAlone) {
  map_.AddKeyframe(test::MakeKeyframe(1, 0, 0.0, {}, MapId(1)));
  const DepthView view = ViewOf(Wall(4.0));
  WatchedFrame frame;
  frame.map = MapId(1);
  frame.view = &view;
  watch_.Look(frame, map_);
  EXPECT_TRUE(watch_.Take().empty());
}

TEST_F(ObjectWatchTest, SurvivesAThousandSightings) {
  std::vector<ObjectSighting> sightings;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    sightings.push_back(SightingAt(1.0 + 0.002 * i, static_cast<int>(i) % 80, At(1.0)));
    sightings.back().track = TrackId(i);
  }
  Look(1.0, WithPanel(kDepthM), sightings);
  EXPECT_LE(Taken().num_seen, 1);
}

TEST_F(ObjectWatchTest, DoesNothingWhenSwitchedOff) {
  ObjectWatchOptions options;
  options.enabled = false;
  ObjectWatch off(options);
  const DepthView view = ViewOf(Wall(4.0));
  WatchedFrame frame;
  frame.map = MapId(0);
  frame.view = &view;
  off.Look(frame, map_);
  EXPECT_TRUE(off.Take().empty());
}

}  // namespace
}  // namespace cslam
