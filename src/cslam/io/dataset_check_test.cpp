// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/dataset_check.h"

#include "cslam/io/test_sequence.h"
#include "cslam/util/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cslam {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(CheckDataset, FindsNothingInASoundSequence) {
  const TestSequence sequence(4);
  sequence.folder().Write("groundtruth.txt",
                          "0.0 0 0 0 0 0 0 1\n0.05 0 0 0 0 0 0 1\n0.1 0 0 1 0 0 0 1\n"
                          "0.15 0 0 1 0 0 0 1\n");
  const DatasetCheck check = CheckDataset(sequence.path(), {});
  EXPECT_THAT(check.errors, IsEmpty());
  EXPECT_THAT(check.warnings, IsEmpty());
  EXPECT_EQ(check.num_frames, 4U);
  EXPECT_EQ(check.num_checked, 4U);
  EXPECT_EQ(check.depth_valid_share, 1.0);
}

TEST(CheckDataset, CountsEachKindOfBrokenFrame) {
  const TestSequence sequence(6);
  std::filesystem::remove(sequence.Color(1));
  std::filesystem::resize_file(sequence.Depth(2), 40);
  sequence.WriteDepth(3, 10, 10, 1500);
  WritePng(sequence.Depth(4), cv::Mat(48, 64, CV_8UC1, cv::Scalar(1)));
  const DatasetCheck check = CheckDataset(sequence.path(), {});
  EXPECT_EQ(check.num_missing, 1U);
  EXPECT_EQ(check.num_unreadable, 2U);
  EXPECT_EQ(check.num_wrong_size, 1U);
  EXPECT_THAT(check.errors,
              ElementsAre(AllOf(HasSubstr("frame 1:"), HasSubstr("does not exist")),
                          AllOf(HasSubstr("frame 2:"), HasSubstr("truncated")),
                          AllOf(HasSubstr("frame 4:"), HasSubstr("expected 16-bit")),
                          AllOf(HasSubstr("frame 3:"), HasSubstr("10x10"), HasSubstr("64x48"))));
}

TEST(CheckDataset, LooksForFilesOutsideTheSampleToo) {
  const TestSequence sequence(5);
  std::filesystem::remove(sequence.Depth(1));
  const DatasetCheck check = CheckDataset(sequence.path(), {}, 2);
  EXPECT_EQ(check.num_checked, 2U);
  EXPECT_THAT(check.errors, ElementsAre(HasSubstr("frame 1:")));
}

TEST(CheckDataset, ShortensLongSeries) {
  const TestSequence sequence(9);
  std::filesystem::remove_all(sequence.path() / "depth");
  const DatasetCheck check = CheckDataset(sequence.path(), {});
  EXPECT_EQ(check.num_missing, 9U);
  ASSERT_EQ(check.errors.size(), 6U);
  EXPECT_EQ(check.errors.back(), "... and 4 more frames with a missing image");
}

TEST(CheckDataset, WarnsOfFramesWithoutDepth) {
  const TestSequence sequence(3);
  sequence.WriteDepth(1, 64, 48, 0);
  const DatasetCheck check = CheckDataset(sequence.path(), {});
  EXPECT_THAT(check.errors, IsEmpty());
  EXPECT_EQ(check.num_without_depth, 1U);
  EXPECT_THAT(check.warnings, ElementsAre("frame 1: depth has no reading at all"));
}

TEST(CheckDataset, WarnsOfTimesThatLookWrong) {
  const TestSequence sequence(3);
  sequence.folder().Write("associations.txt",
                          "0.0 rgb/0.png 0.05 depth/0.png\n0.2 rgb/1.png 0.2 depth/1.png\n"
                          "0.22 rgb/2.png 0.2 depth/1.png\n");
  EXPECT_THAT(
      CheckDataset(sequence.path(), {}).warnings,
      ElementsAre("0.200 s without a frame after frame 0", "frame 0: depth is 0.050 s after colour",
                  "frame 2: its depth image is also that of the frame before"));
}

TEST(CheckDataset, DoesNotTakeASlowRateForPauses) {
  const TestSequence sequence(4);
  sequence.folder().Write("associations.txt",
                          "0.0 rgb/0.png 0.0 depth/0.png\n0.5 rgb/1.png 0.5 depth/1.png\n"
                          "1.0 rgb/2.png 1.0 depth/2.png\n2.0 rgb/3.png 2.0 depth/3.png\n");
  EXPECT_THAT(CheckDataset(sequence.path(), {}).warnings,
              ElementsAre("1.000 s without a frame after frame 2"));
}

TEST(CheckDataset, WarnsOfImagesWithoutPartner) {
  const TestSequence sequence(3);
  std::filesystem::remove(sequence.path() / "associations.txt");
  sequence.folder().Write("rgb.txt", "0 rgb/0.png\n0.05 rgb/1.png\n0.1 rgb/2.png\n");
  sequence.folder().Write("depth.txt", "0 depth/0.png\n0.05 depth/1.png\n");
  EXPECT_THAT(CheckDataset(sequence.path(), {}).warnings,
              ElementsAre("1 colour and 0 depth images have no partner within 0.02 s"));
}

TEST(CheckDataset, JudgesTheGroundTruth) {
  const TestSequence sequence(3);
  sequence.folder().Write("groundtruth.txt", "0.0 0 0 0 0 0 0 1\n");
  sequence.folder().Write("groundtruth_camera.txt", "0.0 0 0 0 0 0 0\n");
  const DatasetCheck check = CheckDataset(sequence.path(), {});
  EXPECT_THAT(check.warnings,
              ElementsAre("groundtruth.txt has a pose within 0.02 s for 1 of 3 frames"));
  EXPECT_THAT(check.errors, ElementsAre(HasSubstr("groundtruth_camera.txt:1")));
}

TEST(CheckDataset, DoubtsADepthScaleThatMakesRoomsOfTheWrongSize) {
  const TestSequence sequence(2);
  CameraChoice choice;
  choice.depth_units_per_m = 10.0;
  EXPECT_THAT(CheckDataset(sequence.path(), choice).warnings,
              ElementsAre(AllOf(HasSubstr("150 m"), HasSubstr("depth scale"))));
}

TEST(CheckDataset, ComparesSizesEvenWithoutACamera) {
  const TestSequence sequence(3);
  std::filesystem::remove(sequence.path() / "camera.yaml");
  sequence.WriteColor(2, 32, 48);
  const DatasetCheck check = CheckDataset(sequence.path(), {});
  EXPECT_THAT(check.warnings, ElementsAre(HasSubstr("no camera known")));
  EXPECT_THAT(check.errors, ElementsAre(AllOf(HasSubstr("32x48"), HasSubstr("64x48"))));
}

TEST(CheckDataset, ReportsBrokenListsAsErrors) {
  const TestSequence sequence(2);
  sequence.folder().Write("associations.txt", "0.0 rgb/0.png\n");
  EXPECT_THAT(CheckDataset(sequence.path(), {}).errors,
              ElementsAre(HasSubstr("associations.txt:1: expected")));
}

TEST(CheckDataset, ReportsABrokenCameraFileAsError) {
  const TestSequence sequence(2);
  sequence.folder().Write("camera.yaml", "fx: .nan\n");
  EXPECT_THAT(CheckDataset(sequence.path(), {}).errors, ElementsAre(HasSubstr("camera.yaml")));
}

TEST(CheckDataset, RefusesWhatIsNoDataset) {
  const TestFolder folder;
  EXPECT_THROW(CheckDataset(folder.path(), {}), Error);
}

}  // namespace
}  // namespace cslam
