// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/frame_pictures.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace cslam {
namespace {

// Lines are anti-aliased, so a colour hardly appears pure.
bool HasColour(const cv::Mat& picture, const cv::Vec3b& colour) {
  constexpr double kTolerance = 60.0;
  for (int v = 0; v < picture.rows; ++v) {
    for (int u = 0; u < picture.cols; ++u) {
      if (cv::norm(cv::Vec3d(picture.at<cv::Vec3b>(v, u)) - cv::Vec3d(colour)) < kTolerance) {
        return true;
      }
    }
  }
  return false;
}

TEST(DrawFrame, ColoursKeypointsByLabelAndLeavesTheInputAlone) {
  const cv::Mat bgr(240, 320, CV_8UC3, cv::Scalar(128, 128, 128));
  TrackingResult result;
  result.keypoints = {{{50.0F, 60.0F}, KeypointLabel::kStatic},
                      {{100.0F, 60.0F}, KeypointLabel::kMovable},
                      {{150.0F, 60.0F}, KeypointLabel::kDynamic}};
  const cv::Mat picture = DrawFrame(bgr, result);
  EXPECT_TRUE(HasColour(picture.rowRange(50, 70).colRange(40, 60), {60, 200, 60}));
  EXPECT_TRUE(HasColour(picture.rowRange(50, 70).colRange(90, 110), {0, 215, 255}));
  EXPECT_TRUE(HasColour(picture.rowRange(50, 70).colRange(140, 160), {40, 40, 230}));
  EXPECT_EQ(cv::sum(bgr)[0], 128.0 * 240 * 320);
}

TEST(DrawFrame, FramesObjectsEvenPartlyOutsideThePicture) {
  const cv::Mat bgr(240, 320, CV_8UC3, cv::Scalar(128, 128, 128));
  TrackingResult result;
  TrackedObject object;
  object.class_id = 0;
  object.box = {-20.0, 30.0, 100.0, 500.0};
  object.is_detected = true;
  result.objects = {object};
  EXPECT_TRUE(HasColour(DrawFrame(bgr, result), {40, 40, 230}));
}

}  // namespace
}  // namespace cslam
