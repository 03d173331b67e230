// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/tum_dataset.h"

#include "cslam/io/test_sequence.h"
#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <string>

namespace cslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr int kWidth = TestSequence::kWidth;
constexpr int kHeight = TestSequence::kHeight;

std::string OpenError(const TestSequence& sequence, const DatasetOptions& options = {}) {
  return MessageOf([&] { OpenDataset(sequence.path(), options); });
}

TEST(TumDataset, LoadsGrayColourAndDepthInMetres) {
  const TestSequence sequence(4);
  const auto dataset = OpenDataset(sequence.path());
  ASSERT_EQ(dataset->size(), 4U);
  const LoadResult result = dataset->Load(2);
  ASSERT_TRUE(result.frame.has_value()) << result.problem;
  EXPECT_EQ(result.problem, "");
  EXPECT_EQ(result.frame->id, FrameId(2));
  EXPECT_EQ(result.frame->stamp, Stamp{100'000'000});
  EXPECT_EQ(dataset->stamp(2), result.frame->stamp);
  EXPECT_EQ(result.frame->bgr.at<cv::Vec3b>(5, 5), cv::Vec3b(20, 20, 30));
  EXPECT_EQ(result.frame->gray.type(), CV_8UC1);
  EXPECT_EQ(result.frame->gray.at<unsigned char>(5, 5), 23);  // 0.114 B + 0.587 G + 0.299 R
  EXPECT_EQ(result.frame->depth_m.type(), CV_32FC1);
  EXPECT_EQ(result.frame->depth_m.at<float>(5, 5), 1.502F);
  EXPECT_EQ(dataset->camera().source, "camera.yaml in the folder");
}

TEST(TumDataset, PlaysAPartAndKeepsTheIds) {
  const TestSequence sequence(4);
  const auto dataset =
      OpenDataset(sequence.path(), {.camera = {}, .from = 1, .frames = 2, .is_strict = false});
  ASSERT_EQ(dataset->size(), 2U);
  EXPECT_EQ(dataset->Load(0).frame->id, FrameId(1));
  EXPECT_EQ(dataset->stamp(1), Stamp{100'000'000});
  EXPECT_EQ(OpenDataset(sequence.path(), {.camera = {}, .from = 3, .frames = 9, .is_strict = false})
                ->size(),
            1U);
}

TEST(TumDataset, RefusesAPartWithoutFrames) {
  const TestSequence sequence(4);
  EXPECT_THAT(OpenError(sequence, {.camera = {}, .from = 4, .frames = {}, .is_strict = false}),
              HasSubstr("has 4 frames (0 to 3); there is nothing from frame 4 on"));
  EXPECT_THAT(OpenError(sequence, {.camera = {}, .from = 0, .frames = 0, .is_strict = false}),
              HasSubstr("0 frames were asked for"));
}

TEST(TumDataset, OverridesTheDepthScale) {
  const TestSequence sequence(4);
  DatasetOptions options;
  options.camera.depth_units_per_m = 5000.0;
  EXPECT_EQ(OpenDataset(sequence.path(), options)->Load(0).frame->depth_m.at<float>(0, 0), 0.3F);
}

TEST(TumDataset, SkipsAMissingImageWithItsName) {
  const TestSequence sequence(4);
  std::filesystem::remove(sequence.Depth(1));
  const auto dataset = OpenDataset(sequence.path());
  const LoadResult result = dataset->Load(1);
  EXPECT_FALSE(result.frame.has_value());
  EXPECT_EQ(result.fault, FrameFault::kMissing);
  EXPECT_THAT(result.problem,
              AllOf(HasSubstr(sequence.Depth(1).string()), HasSubstr("does not exist")));
  EXPECT_TRUE(dataset->Load(2).frame.has_value());
}

TEST(TumDataset, SkipsATruncatedImageWithTheReason) {
  const TestSequence sequence(4);
  std::filesystem::resize_file(sequence.Color(1),
                               std::filesystem::file_size(sequence.Color(1)) - 20);
  const LoadResult result = OpenDataset(sequence.path())->Load(1);
  EXPECT_EQ(result.fault, FrameFault::kUnreadable);
  EXPECT_THAT(result.problem, AllOf(HasSubstr(sequence.Color(1).string()), HasSubstr("truncated")));
}

TEST(TumDataset, SkipsAnImageOfWrongTypeOrSize) {
  const TestSequence sequence(4);
  WritePng(sequence.Depth(1), cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(9)));
  sequence.WriteDepth(2, kWidth, kHeight / 2, 9);
  sequence.WriteColor(3, kWidth / 2, kHeight);
  const auto dataset = OpenDataset(sequence.path());
  EXPECT_EQ(dataset->Load(1).fault, FrameFault::kUnreadable);
  EXPECT_THAT(dataset->Load(1).problem, HasSubstr("expected 16-bit"));
  EXPECT_EQ(dataset->Load(2).fault, FrameFault::kWrongSize);
  EXPECT_THAT(dataset->Load(2).problem, AllOf(HasSubstr("64x24"), HasSubstr("64x48")));
  EXPECT_EQ(dataset->Load(3).fault, FrameFault::kWrongSize);
}

TEST(TumDataset, StopsAtAnUnreadableFrameWhenStrict) {
  const TestSequence sequence(4);
  std::filesystem::remove(sequence.Depth(1));
  const auto dataset =
      OpenDataset(sequence.path(), {.camera = {}, .from = 0, .frames = {}, .is_strict = true});
  EXPECT_TRUE(dataset->Load(0).frame.has_value());
  EXPECT_THAT(MessageOf([&] { dataset->Load(1); }),
              AllOf(HasSubstr("frame 1:"), HasSubstr("does not exist"), HasSubstr("--strict")));
}

TEST(TumDataset, LoadsDepthWithoutAnyReading) {
  const TestSequence sequence(4);
  sequence.WriteDepth(1, kWidth, kHeight, 0);
  const LoadResult result = OpenDataset(sequence.path())->Load(1);
  ASSERT_TRUE(result.frame.has_value());
  EXPECT_EQ(cv::countNonZero(result.frame->depth_m), 0);
}

TEST(TumDataset, NamesBothSizesWhenTheCameraIsOfAnother) {
  const TestSequence sequence(4);
  DatasetOptions options;
  options.camera.camera = "tum_fr1";
  EXPECT_THAT(
      OpenError(sequence, options),
      AllOf(HasSubstr("is 64x48"), HasSubstr("(tum_fr1) is 640x480"), HasSubstr("--camera")));
}

TEST(TumDataset, RefusesASequenceOfWhichNothingCanBeRead) {
  const TestSequence sequence(4);
  std::filesystem::remove_all(sequence.path() / "depth");
  EXPECT_THAT(OpenError(sequence), AllOf(HasSubstr("none of the 4 frames can be read"),
                                         HasSubstr(sequence.Depth(0).string())));
}

TEST(TumDataset, OpensASequenceWhoseFirstFramesAreBad) {
  const TestSequence sequence(4);
  std::filesystem::remove(sequence.Color(0));
  sequence.WriteColor(1, kWidth / 2, kHeight);
  EXPECT_EQ(OpenDataset(sequence.path())->size(), 4U);
}

TEST(TumDataset, ReportsGroundTruth) {
  const TestSequence sequence(4);
  EXPECT_EQ(OpenDataset(sequence.path())->ground_truth(), std::nullopt);
  sequence.folder().Write("groundtruth_camera.txt", "");
  EXPECT_EQ(OpenDataset(sequence.path())->ground_truth(),
            sequence.path() / "groundtruth_camera.txt");
  sequence.folder().Write("groundtruth.txt", "");
  EXPECT_EQ(OpenDataset(sequence.path())->ground_truth(), sequence.path() / "groundtruth.txt");
}

TEST(OpenDataset, SaysWhatIsWrongWithAPlaceThatIsNoDataset) {
  const TestFolder folder;
  EXPECT_THAT(MessageOf([&] { OpenDataset(folder / "none"); }),
              AllOf(HasSubstr("no such folder"), HasSubstr("none")));
  const auto file = folder.Write("file.bag", "x");
  EXPECT_THAT(MessageOf([&] { OpenDataset(file); }), HasSubstr("is a file"));
  std::filesystem::create_directories(folder / "rgb");
  EXPECT_THAT(MessageOf([&] { OpenDataset(folder.path()); }),
              AllOf(HasSubstr("is no data set"), HasSubstr("associations.txt"),
                    HasSubstr("rgb.txt or rgb/"), HasSubstr("depth.txt or depth/")));
}

TEST(OpenDataset, PointsAtADatasetInsideTheFolder) {
  const TestFolder folder;
  folder.Write("b/associations.txt", "");
  folder.Write("a/associations.txt", "");
  EXPECT_THAT(MessageOf([&] { OpenDataset(folder.path()); }),
              HasSubstr("did you mean '" + (folder / "a").string() + "'?"));
}

TEST(OpenDataset, AsksForACameraWhenNoneIsKnown) {
  const TestFolder folder;
  folder.Write("kitchen/associations.txt", "1 rgb/a.png 1 depth/a.png\n");
  EXPECT_THAT(MessageOf([&] { OpenDataset(folder / "kitchen"); }),
              AllOf(HasSubstr("no camera known"), HasSubstr("tum_fr1")));
}

}  // namespace
}  // namespace cslam
