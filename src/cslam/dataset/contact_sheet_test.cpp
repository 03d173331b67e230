// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/contact_sheet.h"

#include "cslam/io/image_codec.h"
#include "cslam/util/test_folder.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <string>
#include <vector>

namespace cslam {
namespace {

// Frames of one grey each, a second apart: the brightness tells which is shown.
std::vector<SheetFrame> GreyFrames(const TestFolder& folder, int count) {
  std::vector<SheetFrame> frames;
  for (int i = 0; i < count; ++i) {
    const auto file = folder / (std::to_string(i) + ".png");
    WritePng(file, cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(i)));
    frames.push_back({static_cast<double>(i), file});
  }
  return frames;
}

cv::Mat3b Sheet(const std::vector<SheetFrame>& frames, const TrueChanges& changes = {}) {
  return MakeContactSheet(frames, TrueObjects{}, changes);
}

// Pixels whose red is well above their blue: what changes are written in.
int CountRed(const cv::Mat3b& image) {
  int count = 0;
  for (const cv::Vec3b& bgr : image)
    count += bgr[2] > bgr[0] + 100;
  return count;
}

TEST(MakeContactSheet, ShowsTwelveFramesFromFirstToLast) {
  const TestFolder folder;
  const cv::Mat3b sheet = Sheet(GreyFrames(folder, 100));
  ASSERT_EQ(sheet.cols, 4 * 328 + 8);
  const int height = (sheet.rows - 8) / 3;
  std::vector<int> shown;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column)
      shown.push_back(sheet(20 + row * height, 20 + column * 328)[0]);
  }
  EXPECT_EQ(shown, (std::vector<int>{0, 9, 18, 27, 36, 45, 54, 63, 72, 81, 90, 99}));
}

TEST(MakeContactSheet, IsSmallerForFewFrames) {
  const TestFolder folder;
  EXPECT_EQ(Sheet(GreyFrames(folder, 1)).cols, 328 + 8);
  EXPECT_LT(Sheet(GreyFrames(folder, 5)).rows, Sheet(GreyFrames(folder, 9)).rows);
}

TEST(MakeContactSheet, TellsBelowAPictureWhatHasChangedBeforeIt) {
  const TestFolder folder;
  const std::vector<SheetFrame> frames = GreyFrames(folder, 3);
  TrueChanges changes;
  changes.changes.push_back({.kind = ChangeKind::kMoved, .time_s = 1.5, .instance = 4});
  const cv::Mat3b sheet = Sheet(frames, changes);
  EXPECT_EQ(CountRed(Sheet(frames)), 0);
  EXPECT_EQ(CountRed(sheet.colRange(0, 2 * 328)), 0);
  EXPECT_GT(CountRed(sheet.colRange(2 * 328, sheet.cols)), 50);
}

TEST(MakeContactSheet, StaysWithinItsCellWhenMuchChangesAtOnce) {
  const TestFolder folder;
  const std::vector<SheetFrame> frames = GreyFrames(folder, 2);
  TrueChanges changes;
  for (int i = 0; i < 20; ++i)
    changes.changes.push_back({.kind = ChangeKind::kRemoved, .time_s = 0.0, .instance = 1000 + i});
  const cv::Mat3b sheet = Sheet(frames, changes);
  EXPECT_GT(CountRed(sheet.colRange(8, 328)), 100);
  EXPECT_EQ(CountRed(sheet.colRange(329, sheet.cols)), 0);
}

}  // namespace
}  // namespace cslam
