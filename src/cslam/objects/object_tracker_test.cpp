// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/objects/object_tracker.h"

#include "cslam/objects/test_depth.h"
#include "cslam/util/check.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace cslam {
namespace {

using test::DrawPanel;
using test::SceneCamera;
using test::Wall;

constexpr int kChair = 56;

// Plays a story in depth images to an ObjectTracker, seen by a camera at rest.
class ObjectTrackerTest : public testing::Test {
 protected:
  struct Seen {
    int class_id;
    Box box;
  };

  ObjectTrackerOptions options_;
  std::unique_ptr<ObjectTracker> tracker_;
  int frame_ = 0;

  static Stamp StampOf(int frame) { return Stamp{1'000'000'000 + frame * 33'333'333LL}; }

  Detections DetectionsOf(int frame, const std::vector<Seen>& seen) const {
    Detections detections;
    detections.frame = FrameId(static_cast<std::uint32_t>(frame));
    detections.stamp = StampOf(frame);
    for (const Seen& s : seen)
      detections.objects.push_back(
          {.class_id = s.class_id, .score = 0.9, .box = s.box, .mask = {}});
    return detections;
  }

  void Play(const cv::Mat& depth_m, const Detections* detections) {
    if (!tracker_) tracker_ = std::make_unique<ObjectTracker>(SceneCamera(), options_);
    tracker_->Observe(FrameId(static_cast<std::uint32_t>(frame_)), StampOf(frame_), depth_m, Se3(),
                      Se3(), detections);
    tracker_->Settle(Se3(), Eigen::Matrix3d::Zero());
    ++frame_;
  }

  void PlayDetected(const cv::Mat& depth_m, const std::vector<Seen>& seen) {
    const Detections detections = DetectionsOf(frame_, seen);
    Play(depth_m, &detections);
  }

  KeypointLabel LabelAt(double u, double v, double depth_m) const {
    Keypoint keypoint;
    keypoint.raw_px = keypoint.uv_px = {static_cast<float>(u), static_cast<float>(v)};
    keypoint.depth_m = static_cast<float>(depth_m);
    return tracker_->Label({&keypoint, 1}).front().label;
  }
};

TEST_F(ObjectTrackerTest, KeepsOneIdWhileAPersonWalks) {
  for (int i = 0; i < 20; ++i) {
    cv::Mat depth = Wall(4.0);
    const Box box = DrawPanel(depth, -0.5 + 0.04 * i, 0.0, 2.0, 0.5, 1.2);
    PlayDetected(depth, {{0, box}});
  }
  ASSERT_EQ(tracker_->objects().size(), 1U);
  EXPECT_EQ(tracker_->objects()[0].track, TrackId(0));
  EXPECT_EQ(tracker_->objects()[0].motion, ObjectMotion::kMoving);
  EXPECT_NEAR(tracker_->objects()[0].velocity_mps.x(), 1.2, 0.2);
}

TEST_F(ObjectTrackerTest, BridgesFramesInWhichTheDetectorMissesThePerson) {
  Box box;
  for (int i = 0; i < 20; ++i) {
    cv::Mat depth = Wall(4.0);
    box = DrawPanel(depth, -0.4 + 0.03 * i, 0.0, 2.0, 0.5, 1.2);
    PlayDetected(depth, i < 8 ? std::vector<Seen>{{0, box}} : std::vector<Seen>{});
  }
  ASSERT_EQ(tracker_->objects().size(), 1U);
  EXPECT_FALSE(tracker_->objects()[0].is_detected);
  EXPECT_GT(Iou(tracker_->objects()[0].box, box), 0.8);
  EXPECT_EQ(LabelAt(0.5 * (box.x_min + box.x_max), 240, 2.0), KeypointLabel::kDynamic);
}

TEST_F(ObjectTrackerTest, FollowsAThingOfTwoNamesOnce) {
  cv::Mat depth = Wall(4.0);
  const Box box = DrawPanel(depth, 0.0, 0.2, 2.0, 0.5, 0.8);
  constexpr int kSuitcase = 28;
  PlayDetected(depth, {{kChair, box}, {kSuitcase, box}});
  ASSERT_EQ(tracker_->objects().size(), 1U);
  EXPECT_EQ(tracker_->objects()[0].class_id, kChair);
}

TEST_F(ObjectTrackerTest, ForgetsWhatIsGone) {
  cv::Mat depth = Wall(4.0);
  const Box box = DrawPanel(depth, 0.0, 0.0, 2.0, 0.5, 1.2);
  PlayDetected(depth, {{0, box}});
  for (int i = 0; i < 10; ++i)
    PlayDetected(Wall(4.0), {});
  EXPECT_TRUE(tracker_->objects().empty());
}

TEST_F(ObjectTrackerTest, CarriesLateDetectionsForward) {
  std::vector<Detections> history;
  Box box;
  constexpr int kDelay = 3;
  for (int i = 0; i < 20; ++i) {
    cv::Mat depth = Wall(4.0);
    box = DrawPanel(depth, -0.4 + 0.03 * i, 0.0, 2.0, 0.5, 1.2);
    history.push_back(DetectionsOf(i, {{0, box}}));
    Play(depth, i >= kDelay ? &history[static_cast<std::size_t>(i - kDelay)] : nullptr);
  }
  ASSERT_EQ(tracker_->objects().size(), 1U);
  EXPECT_GT(Iou(tracker_->objects()[0].box, box), 0.8);
}

TEST_F(ObjectTrackerTest, HoldsBackAChairUntilItIsKnownToRestIfAsked) {
  options_.hold_back_new = true;
  cv::Mat depth = Wall(4.0);
  const Box box = DrawPanel(depth, 0.0, 0.2, 2.0, 0.5, 0.8);
  PlayDetected(depth, {{kChair, box}});
  EXPECT_EQ(LabelAt(320, 280, 2.0), KeypointLabel::kDynamic);
  for (int i = 0; i < 40; ++i)
    PlayDetected(depth, {{kChair, box}});
  EXPECT_EQ(tracker_->objects()[0].motion, ObjectMotion::kStatic);
  EXPECT_EQ(LabelAt(320, 280, 2.0), KeypointLabel::kMovable);
  EXPECT_EQ(LabelAt(20, 280, 4.0), KeypointLabel::kStatic);
}

TEST_F(ObjectTrackerTest, NeverCallsAChairMovingThatAWalkerHides) {
  bool ever_moving = false;
  for (int i = 0; i < 70; ++i) {
    cv::Mat depth = Wall(4.0);
    Box chair = DrawPanel(depth, 0.0, 0.2, 2.5, 0.6, 0.8);
    std::vector<Seen> seen;
    if (i >= 30) {
      const double x = -1.2 + 0.05 * (i - 30);
      const Box person = DrawPanel(depth, x, 0.0, 1.5, 0.5, 1.5);
      seen.push_back({0, person});
      // The detector sees the part of the chair that the person leaves free.
      if (person.x_max > chair.x_min && person.x_min < chair.x_min) chair.x_min = person.x_max;
      if (person.x_min < chair.x_max && person.x_max > chair.x_max) chair.x_max = person.x_min;
    }
    if (chair.width() > 20.0) seen.push_back({kChair, chair});
    PlayDetected(depth, seen);
    for (const TrackedObject& object : tracker_->objects())
      ever_moving =
          ever_moving || (object.class_id == kChair && object.motion == ObjectMotion::kMoving);
  }
  EXPECT_FALSE(ever_moving);
}

TEST_F(ObjectTrackerTest, TellsNoSightingsOfAChairWhileItIsCarried) {
  constexpr int kCarriedFrom = 30;
  constexpr int kCarriedTo = 120;
  constexpr int kNoticedAfter = 15;
  constexpr double kStepM = 0.02;  // a frame: 0.6 m/s
  for (int i = 0; i < kCarriedTo + 60; ++i) {
    cv::Mat depth = Wall(4.0);
    const double x = -0.9 + kStepM * (std::clamp(i, kCarriedFrom, kCarriedTo) - kCarriedFrom);
    PlayDetected(depth, {{kChair, DrawPanel(depth, x, 0.2, 2.0, 0.5, 0.8)}});
    const bool is_carried = i >= kCarriedFrom + kNoticedAfter && i < kCarriedTo;
    const bool rests = i < kCarriedFrom || i >= kCarriedTo + kNoticedAfter;
    const std::size_t num_told = tracker_->Sightings().size();
    if (is_carried || rests) {
      EXPECT_EQ(num_told, rests ? 1U : 0U) << "frame " << i;
    }
  }
}

TEST_F(ObjectTrackerTest, KeepsOneTrackOfAThingThatIsSeenInPieces) {
  cv::Mat depth = Wall(4.0);
  const Box whole = DrawPanel(depth, 0.0, 0.0, 2.0, 0.8, 0.8);
  const Box piece{whole.x_min, whole.y_min, whole.x_min + 0.3 * whole.width(),
                  whole.y_min + 0.3 * whole.height()};
  PlayDetected(depth, {{kChair, piece}});
  ASSERT_EQ(tracker_->objects().size(), 1U);
  for (int i = 0; i < 3; ++i)
    PlayDetected(depth, {{kChair, whole}});
  ASSERT_EQ(tracker_->objects().size(), 1U);
  EXPECT_EQ(tracker_->objects()[0].track, TrackId(0));
  EXPECT_GT(Iou(tracker_->objects()[0].box, whole), 0.9);
}

TEST_F(ObjectTrackerTest, KeepsTwoThingsOfAClassApartWithTiesGoingToTheOlder) {
  cv::Mat depth = Wall(4.0);
  const Box left = DrawPanel(depth, -0.6, 0.2, 2.0, 0.5, 0.8);
  const Box right = DrawPanel(depth, 0.6, 0.2, 2.0, 0.5, 0.8);
  PlayDetected(depth, {{kChair, left}, {kChair, right}});
  PlayDetected(depth, {{kChair, right}, {kChair, left}});
  const auto objects = tracker_->objects();
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects[0].box, left);
  EXPECT_EQ(objects[1].box, right);
}

class TravellerTest : public ObjectTrackerTest {
 protected:
  // A panel moves 0.9 m to the right within a second, then rests for three.
  void PlayTravel() {
    for (int i = 0; i < 120; ++i) {
      cv::Mat depth = Wall(4.0);
      DrawPanel(depth, -0.5 + 0.03 * std::min(i, 30), 0.0, 2.0, 0.5, 0.5);
      if (!tracker_) tracker_ = std::make_unique<ObjectTracker>(SceneCamera(), options_);
      tracker_->Observe(FrameId(static_cast<std::uint32_t>(i)), StampOf(i), depth, Se3(), Se3(),
                        nullptr);
      tracker_->FindUnknown(Se3(), 300);
      tracker_->Settle(Se3(), Eigen::Matrix3d::Zero());
    }
  }
};

TEST_F(TravellerTest, DoesNotTrustWhatCameFarAndHalted) {
  PlayTravel();
  ASSERT_EQ(tracker_->objects().size(), 1U);
  EXPECT_EQ(LabelAt(420, 240, 2.0), KeypointLabel::kDynamic);
}

TEST_F(TravellerTest, TrustsWhatMovedLittleAndRests) {
  options_.left_behind_m = 5.0;
  PlayTravel();
  EXPECT_TRUE(tracker_->objects().empty());
}

TEST_F(ObjectTrackerTest, DoesNotLeaveOutWhatFillsThePictureThoughItSeemsToMove) {
  const auto play = [&](double width_m) {
    tracker_.reset();
    for (int i = 0; i < 20; ++i) {
      cv::Mat depth = Wall(4.0);
      const Box box = DrawPanel(depth, -0.4 + 0.04 * i, 0.0, 1.5, width_m, 1.2);
      PlayDetected(depth, {{kChair, box}});
    }
    return tracker_->objects().at(0);
  };
  EXPECT_EQ(play(0.4).label, KeypointLabel::kDynamic);
  const TrackedObject large = play(1.0);
  EXPECT_EQ(large.motion, ObjectMotion::kMoving);
  EXPECT_EQ(large.label, KeypointLabel::kMovable);
}

// A floor 1 m below the camera, and a wall at 4 m.
cv::Mat Floor() {
  cv::Mat depth_m = Wall(4.0);
  const Camera camera = SceneCamera();
  for (int v = static_cast<int>(camera.cy) + 1; v < depth_m.rows; ++v)
    depth_m.row(v) = std::min(4.0, camera.fy / (v - camera.cy));
  return depth_m;
}

TEST_F(ObjectTrackerTest, TakesARugThatPassesForACouchForTheFloor) {
  constexpr int kCouch = 57;
  PlayDetected(Floor(), {{kCouch, {100, 410, 540, 470}}});
  ASSERT_EQ(tracker_->objects().size(), 1U);
  EXPECT_EQ(LabelAt(320, 440, 525.0 / 200.5), KeypointLabel::kStatic);
  EXPECT_TRUE(tracker_->Sightings().empty()) << "it is no object of the map either";
}

TEST_F(ObjectTrackerTest, CountsFurnitureThatNobodyMovesAsRoom) {
  constexpr int kRefrigerator = 72;
  cv::Mat depth = Wall(4.0);
  const Box box = DrawPanel(depth, 0.0, 0.0, 2.0, 0.6, 1.2);
  PlayDetected(depth, {{kRefrigerator, box}});
  EXPECT_EQ(LabelAt(320, 240, 2.0), KeypointLabel::kStatic);
  EXPECT_TRUE(tracker_->Sightings().empty());
  options_.fixed = "";
  tracker_.reset();
  PlayDetected(depth, {{kRefrigerator, box}});
  EXPECT_EQ(LabelAt(320, 240, 2.0), KeypointLabel::kMovable);
  options_.fixed = "bed wardrobe";
  EXPECT_THROW(ObjectTracker(SceneCamera(), options_), Error);
}

TEST_F(ObjectTrackerTest, HoldsBackASmallThingThatLiesOnTheFloor) {
  constexpr int kBook = 73;
  PlayDetected(Floor(), {{kBook, {290, 425, 350, 455}}});
  EXPECT_EQ(LabelAt(320, 440, 525.0 / 200.5), KeypointLabel::kMovable);
  EXPECT_EQ(tracker_->Sightings().size(), 1U);
}

TEST_F(ObjectTrackerTest, TakesAPictureThatPassesForAScreenForTheWallUnlessToldOtherwise) {
  constexpr int kScreen = 62;
  const std::vector<Seen> picture{{kScreen, {250, 150, 400, 250}}};
  PlayDetected(Wall(3.0), picture);
  EXPECT_EQ(LabelAt(320, 200, 3.0), KeypointLabel::kStatic);
  options_.map_flat_on_walls = true;
  tracker_.reset();
  PlayDetected(Wall(3.0), picture);
  EXPECT_EQ(LabelAt(320, 200, 3.0), KeypointLabel::kMovable);
}

TEST_F(ObjectTrackerTest, FindsAMovingThingThatNobodyNamed) {
  for (int i = 0; i < 30; ++i) {
    cv::Mat depth = Wall(4.0);
    DrawPanel(depth, -0.5 + 0.03 * i, 0.0, 2.0, 0.5, 0.5);
    if (!tracker_) tracker_ = std::make_unique<ObjectTracker>(SceneCamera(), options_);
    tracker_->Observe(FrameId(static_cast<std::uint32_t>(i)), StampOf(i), depth, Se3(), Se3(),
                      nullptr);
    tracker_->FindUnknown(Se3(), 300);
    tracker_->Settle(Se3(), Eigen::Matrix3d::Zero());
  }
  ASSERT_EQ(tracker_->objects().size(), 1U);
  EXPECT_EQ(tracker_->objects()[0].class_id, -1);
  EXPECT_EQ(LabelAt(420, 240, 2.0), KeypointLabel::kDynamic);
}

TEST_F(ObjectTrackerTest, StaysCalmUnderThousandsOfBrokenDetections) {
  std::vector<Seen> seen;
  for (int i = 0; i < 2000; ++i)
    seen.push_back(
        {i % 80, {i % 700 - 30.0, i % 500 - 10.0, i % 640 + 0.5 * (i % 7), i % 480 + 3.0}});
  PlayDetected(Wall(0.0), seen);
  PlayDetected(Wall(2.0), {});
  EXPECT_EQ(LabelAt(320, 240, 2.0), LabelAt(320, 240, 2.0));
}

}  // namespace
}  // namespace cslam
