// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/semantics/recorded_detector.h"

#include "cslam/semantics/coco.h"
#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace cslam {
namespace {

using testing::HasSubstr;

constexpr int kWidth = 160;
constexpr int kHeight = 120;
constexpr std::int64_t kFrameTime_ns = 33'333'333;
const Box kPersonBox{40, 20, 80, 100};
const Box kChairBox{100, 60, 140, 110};

Stamp StampOf(int index) {
  return Stamp{1'000'000'000 + index * kFrameTime_ns};
}

DetectionRecord MakeRecord(int num_frames) {
  DetectionRecord record{
      .sequence = "walking", .width_px = kWidth, .height_px = kHeight, .frames = {}};
  for (int i = 0; i < num_frames; ++i) {
    record.frames.push_back(
        {StampOf(i),
         {{.instance = 3, .class_id = kPersonClass, .score = 1.0, .box = kPersonBox},
          {.instance = 7, .class_id = kChairClass, .score = 1.0, .box = kChairBox}}});
  }
  return record;
}

RgbdFrame MakeFrame(int index) {
  RgbdFrame frame;
  frame.id = FrameId(static_cast<std::uint32_t>(index));
  frame.stamp = StampOf(index);
  frame.gray = cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(0));
  return frame;
}

TEST(RecordedDetector, GivesBackWhatWasRecorded) {
  RecordedDetector detector(MakeRecord(3), "d.json", {});
  const Detections found = detector.Detect(MakeFrame(1));
  EXPECT_EQ(found.frame, FrameId(1));
  EXPECT_EQ(found.stamp, StampOf(1));
  ASSERT_EQ(found.objects.size(), 2U);
  EXPECT_EQ(found.objects[0].class_id, kPersonClass);
  EXPECT_EQ(found.objects[0].box, kPersonBox);
  EXPECT_EQ(found.objects[1].box, kChairBox);
  EXPECT_EQ(detector.info().kind, "recorded");
  EXPECT_EQ(detector.info().name, "walking");
}

TEST(RecordedDetector, FindsFramesWhoseStampsWereRounded) {
  RecordedDetector detector(MakeRecord(3), "d.json", {});
  RgbdFrame frame = MakeFrame(2);
  frame.stamp = frame.stamp + 400'000;
  EXPECT_EQ(detector.Detect(frame).objects.size(), 2U);
}

TEST(RecordedDetector, SaysSoWhenTheRecordIsOfAnotherSequence) {
  RecordedDetector detector(MakeRecord(3), "d.json", {});
  RgbdFrame frame = MakeFrame(0);
  frame.stamp = Stamp{55'000'000'000};
  EXPECT_THAT(MessageOf([&] { detector.Detect(frame); }),
              HasSubstr("'d.json' has no entry for the frame at 55.000000 s"));
  frame = MakeFrame(0);
  frame.gray = cv::Mat(100, kWidth, CV_8UC1);
  EXPECT_THAT(MessageOf([&] { detector.Detect(frame); }), HasSubstr("160 x 120 px"));
  EXPECT_THAT(MessageOf([] { RecordedDetector(DetectionRecord{}, "d.json", {}); }),
              HasSubstr("no frame in it"));
}

TEST(RecordedDetector, DelayedResultsNameTheFrameTheyBelongTo) {
  RecordedDetector detector(MakeRecord(6), "d.json", {.delay_frames = 2});
  EXPECT_TRUE(detector.Detect(MakeFrame(0)).objects.empty());
  EXPECT_TRUE(detector.Detect(MakeFrame(1)).objects.empty());
  const Detections found = detector.Detect(MakeFrame(3));  // frame 2 was not asked for
  EXPECT_EQ(found.frame, FrameId(0));
  EXPECT_EQ(found.objects.size(), 2U);
  EXPECT_EQ(detector.Detect(MakeFrame(4)).frame, FrameId(1));
  EXPECT_EQ(detector.Detect(MakeFrame(5)).frame, FrameId(3));
}

TEST(Degrade, DropsTheShareThatWasAskedFor) {
  const DetectionRecord record = MakeRecord(2000);
  std::size_t num_kept = 0;
  for (const RecordedFrame& frame : record.frames)
    num_kept += Degrade(frame, record, {.drop_probability = 0.3}).size();
  EXPECT_NEAR(static_cast<double>(num_kept), 0.7 * 4000, 4 * std::sqrt(4000 * 0.3 * 0.7));
  EXPECT_TRUE(Degrade(record.frames[0], record, {.drop_probability = 1.0}).empty());
}

TEST(Degrade, MovesSidesByTheShareThatWasAskedForAndStaysInTheImage) {
  const DetectionRecord record = MakeRecord(2000);
  double sum_of_squares = 0.0;
  for (const RecordedFrame& frame : record.frames) {
    const auto objects = Degrade(frame, record, {.jitter = 0.05});
    ASSERT_EQ(objects.size(), 2U);
    for (const Detection& object : objects) {
      EXPECT_EQ(Intersect(object.box, {0, 0, kWidth, kHeight}), object.box);
      EXPECT_FALSE(object.box.empty());
    }
    sum_of_squares += std::pow((objects[0].box.x_min - kPersonBox.x_min) / 40.0, 2);
  }
  EXPECT_NEAR(std::sqrt(sum_of_squares / 2000), 0.05, 0.004);
}

TEST(Degrade, InventsTheNumberOfBoxesThatWasAskedFor) {
  const DetectionRecord record = MakeRecord(2000);
  std::size_t num_boxes = 0;
  for (const RecordedFrame& frame : record.frames) {
    const auto objects = Degrade(frame, record, {.false_boxes_per_frame = 1.5});
    num_boxes += objects.size() - 2;
    for (const Detection& object : objects) {
      EXPECT_EQ(Intersect(object.box, {0, 0, kWidth, kHeight}), object.box);
      EXPECT_TRUE(object.class_id == kPersonClass || object.class_id == kChairClass);
    }
  }
  EXPECT_NEAR(static_cast<double>(num_boxes), 3000, 4 * std::sqrt(3000));
}

TEST(Degrade, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const DetectionRecord record = MakeRecord(2);
  const DegradeOptions options{.jitter = 0.1, .false_boxes_per_frame = 3.0, .seed = 4};
  DegradeOptions other = options;
  other.seed = 5;
  const auto once = Degrade(record.frames[1], record, options);
  const auto again = Degrade(record.frames[1], record, options);
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i)
    EXPECT_EQ(once[i].box, again[i].box);
  EXPECT_FALSE(once[0].box == Degrade(record.frames[1], record, other)[0].box);
  EXPECT_FALSE(once[0].box == Degrade(record.frames[0], record, options)[0].box);
}

}  // namespace
}  // namespace cslam
