// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Published networks on recorded frames, from $CSLAM_SHARED or ../shared; skipped without.
#include "cslam/io/dataset.h"
#include "cslam/semantics/dnn_detector.h"
#include "cslam/semantics/model_store.h"
#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace cslam {
namespace {

namespace fs = std::filesystem;

constexpr int kNumClasses = 80;

fs::path SharedFolder() {
  const char* const shared = std::getenv("CSLAM_SHARED");
  if (shared != nullptr) return shared;
  return fs::path(CSLAM_SOURCE_DIR).parent_path() / "shared";
}

bool CanConvert() {
  return std::system("/usr/bin/python3 -c 'import onnx' 2>/dev/null") == 0;
}

// Every 25th of the recording's frames, where two people or so are in view, or nobody.
std::vector<RgbdFrame> LoadFrames(const fs::path& folder, std::size_t from) {
  DatasetOptions options;
  options.from = from;
  options.frames = 101;
  const auto dataset = OpenDataset(folder, options);
  std::vector<RgbdFrame> frames;
  for (std::size_t i = 0; i < dataset->size(); i += 25)
    frames.push_back(dataset->Load(i).frame.value());
  return frames;
}

std::size_t NumPeople(const Detections& found) {
  return static_cast<std::size_t>(
      std::ranges::count(found.objects, kPersonClass, &Detection::class_id));
}

class DetectionOnBonnTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(recording_ / "rgb.txt")) GTEST_SKIP() << "no recording in " << recording_;
    if (!fs::exists(plus_)) GTEST_SKIP() << "no networks in " << plus_;
  }

  // The description of a network as tools/convert_model.py makes it.
  ModelDescription Convert(const fs::path& file, const std::string& options) const {
    const std::string command = fmt::format(
        "/usr/bin/python3 -B {}/tools/convert_model.py '{}' --out '{}' --name m {} "
        ">/dev/null 2>&1",
        CSLAM_SOURCE_DIR, file.string(), (folder_ / "out").string(), options);
    CSLAM_CHECK(std::system(command.c_str()) == 0, "{}", command);
    return ReadModelDescription(folder_ / "out/m.yaml");
  }

  ModelDescription Describe(const fs::path& file, const std::string& yaml) const {
    return ReadModelDescription(
        folder_.Write("d/m.yaml", fmt::format("model: {}\n{}", file.string(), yaml)));
  }

  void ExpectToSeePeople(const ModelDescription& model, std::size_t fewest) const {
    DnnDetector detector(model);
    std::size_t num_people = 0;
    for (const RgbdFrame& frame : LoadFrames(recording_, 270)) {
      const std::size_t in_frame = NumPeople(detector.Detect(frame));
      EXPECT_GE(in_frame, 1U) << "frame " << frame.id.value();
      num_people += in_frame;
    }
    EXPECT_GE(num_people, fewest);
    EXPECT_LE(num_people, 20U);  // there are at most four at once
    std::size_t num_false = 0;
    for (const RgbdFrame& frame : LoadFrames(recording_, 0))
      num_false += NumPeople(detector.Detect(frame));
    EXPECT_LE(num_false, 1U);  // thresholds for people are low: a false box costs little
  }

  const fs::path recording_ = SharedFolder() / "data" / "bonn_crowd_part";
  const fs::path plus_ = SharedFolder() / "models" / "nanodet-plus-m";
  TestFolder folder_;
};

// The raw output for one picture, [1, N, C] or [1, C, N].
cv::Mat RawOutput(const fs::path& onnx_file, const cv::Mat& image) {
  cv::Mat input;
  cv::resize(image, input, {416, 416});
  input.convertTo(input, CV_32F);
  input -= cv::Scalar(103.53, 116.28, 123.675);
  input /= cv::Scalar(57.375, 57.12, 58.395);
  cv::dnn::Net net = cv::dnn::readNetFromONNX(onnx_file.string());
  net.setInput(cv::dnn::blobFromImage(input));
  return net.forward().clone();
}

TEST_F(DetectionOnBonnTest, TheRewrittenNetworkEqualsThePlainOne) {
  if (!CanConvert()) GTEST_SKIP() << "python3-onnx is not installed";
  const fs::path plain_file = plus_ / "nanodet-plus-m_416.onnx";
  const ModelDescription fast = Convert(plain_file, "--size 416x416");
  const cv::Mat image = LoadFrames(recording_, 270).front().bgr;
  const cv::Mat expected = RawOutput(plain_file, image);
  const cv::Mat actual = RawOutput(fast.onnx_file, image);
  const int num_cells = expected.size[1];
  const int num_channels = expected.size[2];
  ASSERT_EQ(actual.size[1], num_channels);
  ASSERT_EQ(actual.size[2], num_cells);
  double largest = 0.0;
  for (int channel = 0; channel < num_channels; ++channel) {
    for (int cell = 0; cell < num_cells; ++cell) {
      const double raw = static_cast<double>(actual.at<float>(0, channel, cell));
      const double value = channel < kNumClasses ? 1.0 / (1.0 + std::exp(-raw)) : raw;
      const double plain = static_cast<double>(expected.at<float>(0, cell, channel));
      largest = std::max(largest, std::abs(value - plain));
    }
  }
  EXPECT_LT(largest, 1e-3);
}

TEST_F(DetectionOnBonnTest, ThePlainNetworkGivesTheSameBoxesAsTheRewrittenOne) {
  if (!CanConvert()) GTEST_SKIP() << "python3-onnx is not installed";
  const fs::path file = plus_ / "nanodet-plus-m_416.onnx";
  DnnDetector fast(Convert(file, "--size 416x416"));
  DnnDetector plain(Convert(file, "--plain"));
  for (const RgbdFrame& frame : LoadFrames(recording_, 270)) {
    const auto expected = plain.Detect(frame).objects;
    const auto actual = fast.Detect(frame).objects;
    ASSERT_EQ(actual.size(), expected.size());
    for (std::size_t i = 0; i < actual.size(); ++i) {
      EXPECT_EQ(actual[i].class_id, expected[i].class_id);
      EXPECT_NEAR(actual[i].score, expected[i].score, 1e-3);
      EXPECT_GT(Iou(actual[i].box, expected[i].box), 0.999);
    }
  }
}

TEST_F(DetectionOnBonnTest, TheConvertersNetworkEqualsTheOneRewrittenByHand) {
  if (!CanConvert()) GTEST_SKIP() << "python3-onnx is not installed";
  DnnDetector ours(Convert(plus_ / "nanodet-plus-m_416.onnx", "--size 416x320"));
  DnnDetector theirs(
      Describe(plus_ / "nanodet-plus-m_opt_416x320.onnx",
               "decoder: nanodet-plus\nwidth: 416\nheight: 320\nthresholds: {person: 0.3}\n"));
  for (const RgbdFrame& frame : LoadFrames(recording_, 270)) {
    const auto expected = theirs.Detect(frame).objects;
    const auto actual = ours.Detect(frame).objects;
    ASSERT_EQ(actual.size(), expected.size());
    for (std::size_t i = 0; i < actual.size(); ++i)
      EXPECT_GT(Iou(actual[i].box, expected[i].box), 0.999);
  }
}

TEST_F(DetectionOnBonnTest, NanoDetPlusSeesThePeople) {
  ExpectToSeePeople(
      Describe(plus_ / "nanodet-plus-m_opt_416x320.onnx",
               "decoder: nanodet-plus\nwidth: 416\nheight: 320\nthresholds: {person: 0.3}\n"),
      8);
}

TEST_F(DetectionOnBonnTest, YoloxSeesThePeople) {
  const fs::path file = SharedFolder() / "models/yolox-nano/yolox_nano.onnx";
  if (!fs::exists(file)) GTEST_SKIP() << "no " << file;
  ExpectToSeePeople(
      Describe(file, "decoder: yolox\nwidth: 416\nheight: 416\nthresholds: {person: 0.3}\n"), 8);
}

TEST_F(DetectionOnBonnTest, TheInstalledNanoDetSeesThePeople) {
  const auto models = ListModels(ModelFolders());
  const auto model = std::ranges::find_if(models, [](const InstalledModel& installed) {
    return installed.description && installed.description->name == "nanodet-g";
  });
  if (model == models.end()) GTEST_SKIP() << "nanodet-g is not installed";
  ExpectToSeePeople(*model->description, 7);
}

}  // namespace
}  // namespace cslam
