// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/dataset_info.h"

#include "cslam/io/test_sequence.h"
#include "cslam/util/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cslam {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(EvenSample, SpreadsFromFirstToLast) {
  EXPECT_THAT(EvenSample(10, 4), ElementsAre(0, 3, 6, 9));
  EXPECT_THAT(EvenSample(3, 5), ElementsAre(0, 1, 2));
  EXPECT_THAT(EvenSample(10, 1), ElementsAre(0));
  EXPECT_THAT(EvenSample(0, 4), IsEmpty());
  EXPECT_THAT(EvenSample(4, 0), IsEmpty());
}

TEST(DepthStatistics, CountsPixelsWithAReading) {
  cv::Mat depth_m = cv::Mat::zeros(32, 32, CV_32FC1);
  depth_m.rowRange(0, 8).setTo(2.0F);
  DepthStatistics statistics;
  EXPECT_EQ(statistics.valid_share(), 0.0);
  statistics.Add(depth_m);
  EXPECT_DOUBLE_EQ(statistics.valid_share(), 0.25);
  EXPECT_DOUBLE_EQ(statistics.median_m(), 2.0);
  EXPECT_FALSE(statistics.is_last_empty());
  statistics.Add(cv::Mat::zeros(32, 32, CV_32FC1));
  EXPECT_DOUBLE_EQ(statistics.valid_share(), 0.125);
  EXPECT_TRUE(statistics.is_last_empty());
}

TEST(InspectDataset, DescribesASoundSequence) {
  const TestSequence sequence(5);
  const DatasetInfo info = InspectDataset(sequence.path(), {}, 3);
  EXPECT_EQ(info.num_frames, 5U);
  EXPECT_EQ(info.pair_source, "associations.txt");
  EXPECT_DOUBLE_EQ(info.duration_s, 0.2);
  EXPECT_NEAR(info.rate_hz, 20.0, 1e-9);
  EXPECT_THAT(info.gaps, IsEmpty());
  EXPECT_DOUBLE_EQ(info.mean_pair_difference_s, 0.004);
  EXPECT_EQ(info.width_px, 64);
  EXPECT_EQ(info.height_px, 48);
  EXPECT_EQ(info.color_format, ".png");
  ASSERT_TRUE(info.camera.has_value());
  EXPECT_EQ(info.camera->source, "camera.yaml in the folder");
  EXPECT_FALSE(info.ground_truth.has_value());
  EXPECT_EQ(info.num_sampled, 3U);
  EXPECT_EQ(info.num_unreadable, 0U);
  EXPECT_EQ(info.depth_valid_share, 1.0);
  EXPECT_NEAR(info.median_depth_m, 1.502, 1e-6);
}

TEST(InspectDataset, FindsPauses) {
  const TestSequence sequence(2);
  sequence.folder().Write("associations.txt",
                          "0.0 rgb/0.png 0.0 depth/0.png\n0.3 rgb/1.png 0.3 depth/1.png\n");
  const DatasetInfo info = InspectDataset(sequence.path(), {}, 2);
  ASSERT_EQ(info.gaps.size(), 1U);
  EXPECT_EQ(info.gaps[0].frame, 0U);
  EXPECT_DOUBLE_EQ(info.gaps[0].length_s, 0.3);
}

TEST(InspectDataset, MeasuresTheGroundTruth) {
  const TestSequence sequence(5);
  sequence.folder().Write("groundtruth.txt",
                          "0.0 0 0 0 0 0 0 1\n0.05 3 4 0 0 0 0 1\n0.1 3 4 1 0 0 0 1\n");
  const DatasetInfo info = InspectDataset(sequence.path(), {}, 1);
  ASSERT_TRUE(info.ground_truth.has_value());
  EXPECT_EQ(info.ground_truth->num_poses, 3U);
  EXPECT_DOUBLE_EQ(info.ground_truth->path_length_m, 6.0);
  EXPECT_EQ(info.ground_truth->num_covered_frames, 3U);
  EXPECT_EQ(info.ground_truth->problem, "");
}

TEST(InspectDataset, TellsOfAGroundTruthThatCannotBeRead) {
  const TestSequence sequence(2);
  sequence.folder().Write("groundtruth.txt", "0.0 0 0\n");
  const DatasetInfo info = InspectDataset(sequence.path(), {}, 1);
  ASSERT_TRUE(info.ground_truth.has_value());
  EXPECT_THAT(info.ground_truth->problem, HasSubstr("groundtruth.txt:1"));
}

TEST(InspectDataset, WorksWithoutACamera) {
  const TestSequence sequence(2);
  std::filesystem::remove(sequence.path() / "camera.yaml");
  const DatasetInfo info = InspectDataset(sequence.path(), {}, 2);
  EXPECT_FALSE(info.camera.has_value());
  EXPECT_THAT(info.camera_problem, HasSubstr("no camera known"));
  EXPECT_EQ(info.num_unreadable, 0U);
  EXPECT_EQ(info.depth_valid_share, 1.0);
}

TEST(InspectDataset, CountsSampledFramesThatCannotBeRead) {
  const TestSequence sequence(3);
  std::filesystem::remove(sequence.Color(0));
  const DatasetInfo info = InspectDataset(sequence.path(), {}, 3);
  EXPECT_EQ(info.num_unreadable, 1U);
  EXPECT_THAT(info.first_problem, HasSubstr(sequence.Color(0).string()));
  EXPECT_EQ(info.width_px, 64);
}

TEST(InspectDataset, RefusesWhatIsNoDataset) {
  const TestFolder folder;
  EXPECT_THROW(InspectDataset(folder.path(), {}, 1), Error);
}

}  // namespace
}  // namespace cslam
