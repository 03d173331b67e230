// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// A robot that stands still while a thing before it is taken away: nothing but the thing asks for a
// keyframe.
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "e2e_support.h"

namespace cslam {
namespace {

constexpr int kSuitcase = 28;
constexpr int kWithIt = 90;     // frames of 1/30 s in which it stands there
constexpr int kWithoutIt = 90;  // and those after
constexpr double kMaxDelayS = 2.0;
const cv::Rect kBox(120, 90, 80, 80);  // px, of 320 x 240
constexpr float kDepthM = 1.2F;

// Sees the suitcase in the frames before it is taken away.
class SuitcaseDetector final : public Detector {
 public:
  Detections Detect(const RgbdFrame& frame) override {
    Detections found{frame.id, frame.stamp, {}};
    if (frame.id.value() >= kWithIt) return found;
    const cv::Point end = kBox.br();
    found.objects.push_back({.class_id = kSuitcase,
                             .score = 0.8,
                             .box = {static_cast<double>(kBox.x), static_cast<double>(kBox.y),
                                     static_cast<double>(end.x), static_cast<double>(end.y)},
                             .mask = {}});
    return found;
  }
  DetectorInfo info() const override { return {.kind = "recorded", .name = "test", .source = ""}; }
};

// The view with a checked board before it.
RgbdFrame WithSuitcase(const RgbdFrame& view) {
  RgbdFrame frame = view;
  frame.gray = view.gray.clone();
  frame.bgr = view.bgr.clone();
  frame.depth_m = view.depth_m.clone();
  constexpr int kCellPx = 9;
  for (int y = kBox.y; y < kBox.br().y; ++y) {
    for (int x = kBox.x; x < kBox.br().x; ++x) {
      const bool is_light = ((x / kCellPx) + (y / kCellPx) + (x * y / 700)) % 2 == 0;
      frame.gray.at<std::uint8_t>(y, x) = is_light ? 200 : 60;
      frame.bgr.at<cv::Vec3b>(y, x) = is_light ? cv::Vec3b(90, 180, 230) : cv::Vec3b(20, 50, 110);
      frame.depth_m.at<float>(y, x) = kDepthM;
    }
  }
  return frame;
}

class StandingRobotTest : public testing::TestWithParam<Execution> {};

TEST_P(StandingRobotTest, NoticesWithinTwoSecondsThatAThingIsGone) {
  const auto room = test::MakeTestFrames(
      {.width = 320, .height = 240, .num_frames = 1, .noise = SensorNoise::kOff});
  const RgbdFrame empty = *room.frames.at(0);
  const RgbdFrame full = WithSuitcase(empty);
  Slam slam(room.camera, test::CheckedOptions(), GetParam(), {}, FeedPolicy::kWait,
            std::make_unique<SuitcaseDetector>());
  Stamp taken_away;
  for (int i = 0; i < kWithIt + kWithoutIt; ++i) {
    RgbdFrame frame = i < kWithIt ? full : empty;
    frame.id = FrameId(static_cast<std::uint32_t>(i));
    frame.stamp = Stamp{1'000'000'000 + i * 33'333'333LL};
    if (i == kWithIt) taken_away = frame.stamp;
    slam.Feed(std::make_shared<const RgbdFrame>(std::move(frame)));
  }
  const MapView& map = slam.Finish().snapshot->map;
  ASSERT_EQ(map.changes().size(), 1U);
  const MapChange& change = map.changes()[0];
  EXPECT_EQ(change.kind, MapChangeKind::kRemoved);
  EXPECT_EQ(map.FindObject(change.object)->class_id, kSuitcase);
  const double delay_s = SecondsBetween(change.reported, taken_away);
  RecordProperty("delay_ms", std::to_string(1e3 * delay_s));
  EXPECT_GT(delay_s, 0.0);
  EXPECT_LT(delay_s, kMaxDelayS);
}

INSTANTIATE_TEST_SUITE_P(BothExecutions, StandingRobotTest,
                         testing::Values(Execution::kInline, Execution::kThreaded));

}  // namespace
}  // namespace cslam
