// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/semantics/dnn_detector.h"

#include "cslam/semantics/test_network.h"
#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace cslam {
namespace {

using testing::HasSubstr;

using test::BrightnessNetwork;

constexpr int kSize = test::kBrightnessSize;
constexpr const char* kYaml = test::kBrightnessYaml;
constexpr const char* kNoMean = test::kBrightnessMean;

// An image of twice the input's width whose cell at column 2, row 1 is bright in one channel.
RgbdFrame MakeFrame(int channel) {
  RgbdFrame frame;
  frame.id = FrameId(5);
  frame.stamp = Stamp{77};
  frame.bgr = cv::Mat(kSize, 2 * kSize, CV_8UC3, cv::Scalar::all(0));
  cv::Scalar color = cv::Scalar::all(0);
  color[channel] = 255;
  frame.bgr(cv::Rect(32, 8, 16, 8)).setTo(color);
  return frame;
}

class DnnDetectorTest : public testing::Test {
 protected:
  DnnDetector Make(const std::string& extra_yaml, std::size_t channel = 0,
                   const std::string& mean = kNoMean) const {
    folder_.Write("net.onnx", BrightnessNetwork(channel));
    return DnnDetector(ReadModelDescription(folder_.Write("net.yaml", kYaml + mean + extra_yaml)));
  }

  TestFolder folder_;
};

TEST_F(DnnDetectorTest, FindsTheBoxInPixelsOfTheImage) {
  DnnDetector detector = Make("");
  const Detections found = detector.Detect(MakeFrame(0));
  EXPECT_EQ(found.frame, FrameId(5));
  EXPECT_EQ(found.stamp, Stamp{77});
  ASSERT_EQ(found.objects.size(), 1U);
  EXPECT_EQ(found.objects[0].class_id, kPersonClass);
  EXPECT_NEAR(found.objects[0].score, 1.0 / (1.0 + std::exp(-7.0)), 1e-4);
  const Box& box = found.objects[0].box;
  EXPECT_NEAR(box.x_min, 32.0, 1e-3);
  EXPECT_NEAR(box.y_min, 8.0, 1e-3);
  EXPECT_NEAR(box.x_max, 48.0, 1e-3);
  EXPECT_NEAR(box.y_max, 16.0, 1e-3);
  EXPECT_EQ(detector.info().kind, "dnn");
  EXPECT_EQ(detector.info().name, "net");
}

TEST_F(DnnDetectorTest, GivesTheNetworkTheOrderOfChannelsItWants) {
  EXPECT_TRUE(Make("").Detect(MakeFrame(2)).objects.empty());
  EXPECT_EQ(Make("channels: rgb\n").Detect(MakeFrame(2)).objects.size(), 1U);
  EXPECT_EQ(Make("", 2).Detect(MakeFrame(2)).objects.size(), 1U);
}

TEST_F(DnnDetectorTest, SubtractsTheMeanOfEachChannelFirst) {
  EXPECT_TRUE(Make("", 0, "mean: {first: 128, second: 0, third: 0}\n")
                  .Detect(MakeFrame(0))
                  .objects.empty());
  EXPECT_EQ(
      Make("", 0, "mean: {first: 0, second: 128, third: 0}\n").Detect(MakeFrame(0)).objects.size(),
      1U);
}

TEST_F(DnnDetectorTest, LetterboxKeepsTheAspect) {
  const Detections found = Make("resize: letterbox-centered\npad_value: 0\n").Detect(MakeFrame(0));
  EXPECT_TRUE(found.objects.empty());  // half a cell in size now, and half as bright
  RgbdFrame large = MakeFrame(0);
  large.bgr(cv::Rect(32, 0, 16, 16)).setTo(cv::Scalar(255, 0, 0));
  const Detections again = Make("resize: letterbox-centered\npad_value: 0\n").Detect(large);
  ASSERT_EQ(again.objects.size(), 1U);
  EXPECT_NEAR(again.objects[0].box.x_min, 32.0, 1e-3);
  EXPECT_NEAR(again.objects[0].box.y_min, 0.0, 1e-3);
  EXPECT_NEAR(again.objects[0].box.y_max, 16.0, 1e-3);
}

TEST_F(DnnDetectorTest, SeesGreyImagesWhereThereIsNoColour) {
  RgbdFrame frame = MakeFrame(0);
  cv::extractChannel(frame.bgr, frame.gray, 0);
  frame.bgr.release();
  EXPECT_EQ(Make("").Detect(frame).objects.size(), 1U);
}

TEST_F(DnnDetectorTest, GivesEqualResultsForEqualFrames) {
  DnnDetector detector = Make("thresholds: {default: 0.0001}\n");
  const Detections once = detector.Detect(MakeFrame(0));
  detector.Detect(MakeFrame(1));
  const Detections again = detector.Detect(MakeFrame(0));
  ASSERT_EQ(once.objects.size(), again.objects.size());
  for (std::size_t i = 0; i < once.objects.size(); ++i) {
    EXPECT_EQ(once.objects[i].box, again.objects[i].box);
    EXPECT_EQ(once.objects[i].score, again.objects[i].score);
  }
}

TEST_F(DnnDetectorTest, SaysInOneLineWhatIsWrongWithANetwork) {
  const auto message = [&](const std::string& onnx, const std::string& yaml) {
    folder_.Write("net.onnx", onnx);
    return MessageOf([&] { DnnDetector(ReadModelDescription(folder_.Write("net.yaml", yaml))); });
  };
  for (const std::string& broken :
       {std::string("this is not a network"), std::string(), BrightnessNetwork(0).substr(0, 99)}) {
    const std::string text = message(broken, kYaml);
    EXPECT_THAT(text, HasSubstr("net.onnx"));
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  }
  EXPECT_THAT(message(BrightnessNetwork(0), "decoder: yolox\nwidth: 32\nheight: 32\n"),
              HasSubstr("its output [1, 112, 4, 4] does not fit decoder yolox at 32 x 32"));
  EXPECT_THAT(message(BrightnessNetwork(0), "decoder: nanodet\nwidth: 64\nheight: 32\n"),
              HasSubstr("net.onnx"));
  std::filesystem::remove(folder_ / "net.onnx");
  EXPECT_THAT(MessageOf([&] { DnnDetector(ReadModelDescription(folder_ / "net.yaml")); }),
              HasSubstr("there is no network"));
}

}  // namespace
}  // namespace cslam
