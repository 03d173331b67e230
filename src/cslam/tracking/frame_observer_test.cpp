// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/tracking/frame_observer.h"

#include "cslam/objects/test_depth.h"

#include <gtest/gtest.h>

namespace cslam {
namespace {

TEST(FrameObserver, LeavesAPersonOutOfTheDepthKept) {
  RgbdFrame frame;
  frame.id = FrameId(0);
  frame.stamp = Stamp{1'000'000'000};
  frame.gray = cv::Mat(480, 640, CV_8UC1, cv::Scalar(128));
  frame.depth_m = test::Wall(4.0);
  Detection person;
  person.class_id = kPersonClass;
  person.score = 0.9;
  person.box = test::DrawPanel(frame.depth_m, 0.0, 0.0, 2.0, 0.5, 1.6);
  const Detections detections{frame.id, frame.stamp, {person}};
  const TrackerOptions options;
  FrameObserver observer(test::SceneCamera(), options);

  const cv::Mat before = observer.RestingDepth(frame.depth_m);
  TrackingResult result;
  observer.Observe(frame, std::nullopt, &detections, result);
  const cv::Mat after = observer.RestingDepth(frame.depth_m);

  EXPECT_EQ(before.at<std::uint16_t>(60, 80), 2000);
  EXPECT_EQ(after.at<std::uint16_t>(60, 80), 0);
  EXPECT_EQ(after.at<std::uint16_t>(60, 10), 4000);
}

}  // namespace
}  // namespace cslam
