// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/instance_image.h"

#include "cslam/io/image_codec.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <cstdint>

namespace cslam {
namespace {

using testing::HasSubstr;

cv::Mat SomeInstances(int id) {
  cv::Mat instances = cv::Mat::zeros(20, 30, CV_16UC1);
  instances(cv::Rect(5, 6, 7, 8)) = id;
  return instances;
}

TEST(InstanceImage, ReadsBackAsWrittenWithFewAndWithManyObjects) {
  const TestFolder folder;
  for (const int num_instances : {256, 257, 65536}) {
    const cv::Mat instances = SomeInstances(num_instances - 1);
    WriteInstanceImage(folder / "i.png", instances, num_instances);
    const cv::Mat read = ReadInstanceImage(folder / "i.png");
    ASSERT_EQ(read.type(), CV_16UC1);
    EXPECT_EQ(cv::norm(read, instances, cv::NORM_INF), 0.0) << num_instances;
  }
}

TEST(WriteInstanceImage, TakesEightBitsWhileTheyAreEnough) {
  const TestFolder folder;
  WriteInstanceImage(folder / "i.png", SomeInstances(255), 256);
  EXPECT_THAT(MessageOf([&] { ReadDepthImage(folder / "i.png"); }), HasSubstr("8-bit"));
  WriteInstanceImage(folder / "i.png", SomeInstances(256), 257);
  EXPECT_NO_THROW(ReadDepthImage(folder / "i.png"));
}

TEST(ReadInstanceImage, RefusesOtherFiles) {
  const TestFolder folder;
  WritePng(folder / "colour.png", cv::Mat::zeros(4, 4, CV_8UC3));
  EXPECT_THAT(MessageOf([&] { ReadInstanceImage(folder / "colour.png"); }),
              HasSubstr("colour.png' is a 8-bit PNG with 3 channel(s), expected 8 or 16 bits"));
  folder.Write("text.png", "text");
  EXPECT_THAT(MessageOf([&] { ReadInstanceImage(folder / "text.png"); }), HasSubstr("text.png"));
  EXPECT_THAT(MessageOf([&] { ReadInstanceImage(folder / "none.png"); }), HasSubstr("none.png"));
}

}  // namespace
}  // namespace cslam
