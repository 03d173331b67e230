// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/tum_dataset.h"
#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace cslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// The complaint about the folder's lists, without what stands before the name of the list.
std::string Complaint(const TestFolder& folder, const std::string& list) {
  std::string message = MessageOf([&] { ReadTumIndex(folder.path()); });
  const std::size_t name = message.find(list);
  return name == std::string::npos ? message : message.substr(name);
}

TEST(ReadTumIndex, ReadsAssociations) {
  const TestFolder folder;
  folder.Write("associations.txt",
               "# comment\r\n1.5 rgb/a.png 1.51 depth/a.png\r\n\r\n 2.5\trgb/b.png 2.4 "
               "depth/b.png\r\n");
  const TumIndex index = ReadTumIndex(folder.path());
  ASSERT_EQ(index.pairs.size(), 2U);
  EXPECT_EQ(index.pairs[0].color_stamp, Stamp{1'500'000'000});
  EXPECT_EQ(index.pairs[0].depth_stamp, Stamp{1'510'000'000});
  EXPECT_EQ(index.pairs[1].color, folder / "rgb/b.png");
  EXPECT_EQ(index.pairs[1].depth, folder / "depth/b.png");
  EXPECT_EQ(index.source, "associations.txt");
  EXPECT_EQ(index.ground_truth, std::nullopt);
}

TEST(ReadTumIndex, KnowsAssociationsThatNameDepthFirst) {
  const TestFolder folder;
  folder.Write("associations.txt", "1.51 depth/a.png 1.5 rgb/a.png\n");
  const TumIndex index = ReadTumIndex(folder.path());
  EXPECT_EQ(index.pairs[0].color, folder / "rgb/a.png");
  EXPECT_EQ(index.pairs[0].color_stamp, Stamp{1'500'000'000});
}

TEST(ReadTumIndex, AssociatesListsWithin20Milliseconds) {
  const TestFolder folder;
  folder.Write("rgb.txt", "# c\n1.00 rgb/1.png\n1.10 rgb/2.png\n1.20 rgb/3.png\n");
  folder.Write("depth.txt", "1.02 depth/1.png\n1.13 depth/2.png\n1.19 depth/3.png\n");
  const TumIndex index = ReadTumIndex(folder.path());
  ASSERT_EQ(index.pairs.size(), 2U);
  EXPECT_EQ(index.pairs[1].color, folder / "rgb/3.png");
  EXPECT_EQ(index.num_unmatched_color, 1U);
  EXPECT_EQ(index.num_unmatched_depth, 1U);
  EXPECT_EQ(index.source, "nearest stamps of rgb.txt and depth.txt");
}

TEST(ReadTumIndex, TakesFileNamesWhereThereAreNoLists) {
  const TestFolder folder;
  for (const char* name : {"rgb/2.0.jpg", "rgb/1.0.png", "rgb/thumb.png", "rgb/readme.txt",
                           "depth/1.01.png", "depth/2.01.png"}) {
    folder.Write(name, "");
  }
  const TumIndex index = ReadTumIndex(folder.path());
  ASSERT_EQ(index.pairs.size(), 2U);
  EXPECT_EQ(index.pairs[0].color, folder / "rgb/1.0.png");
  EXPECT_EQ(index.pairs[1].depth, folder / "depth/2.01.png");
  EXPECT_EQ(index.num_ignored_files, 1U);
  EXPECT_EQ(index.source, "nearest stamps of rgb/ and depth/");
}

TEST(ReadTumIndex, FindsGroundTruth) {
  const TestFolder folder;
  folder.Write("associations.txt", "1 rgb/a.png 1 depth/a.png\n");
  folder.Write("groundtruth.txt", "");
  folder.Write("groundtruth_camera.txt", "");
  const TumIndex index = ReadTumIndex(folder.path());
  EXPECT_EQ(index.ground_truth, folder / "groundtruth.txt");
  EXPECT_EQ(index.ground_truth_camera, folder / "groundtruth_camera.txt");
}

TEST(ReadTumIndex, NamesTheBrokenLine) {
  const TestFolder folder;
  folder.Write("associations.txt", "# c\n1.0 rgb/a.png 1.0 depth/a.png\n1.1 rgb/b.png 1.1\n");
  EXPECT_EQ(Complaint(folder, "associations.txt"),
            "associations.txt:3: expected 'timestamp colour-file timestamp depth-file', found 3 "
            "field(s)");
  folder.Write("associations.txt", "abc rgb/a.png 1.0 depth/a.png\n");
  EXPECT_EQ(Complaint(folder, "associations.txt"),
            "associations.txt:1: 'abc' is not a timestamp in seconds");
  folder.Write("associations.txt", "1.0 rgb/a.png nan depth/a.png\n");
  EXPECT_EQ(Complaint(folder, "associations.txt"),
            "associations.txt:1: 'nan' is not a timestamp in seconds");
}

TEST(ReadTumIndex, NamesTheBrokenLineOfAnImageList) {
  const TestFolder folder;
  folder.Write("rgb.txt", "1.0 rgb/a.png\n");
  folder.Write("depth.txt", "\n\n1.0\n");
  EXPECT_EQ(Complaint(folder, "depth.txt"),
            "depth.txt:3: expected 'timestamp file', found 1 field(s)");
}

TEST(ReadTumIndex, RefusesTimestampsThatRepeatOrDecrease) {
  const TestFolder folder;
  folder.Write("rgb.txt", "1.0 rgb/a.png\n\n1.0 rgb/b.png\n");
  folder.Write("depth.txt", "1.0 depth/a.png\n");
  EXPECT_EQ(Complaint(folder, "rgb.txt"),
            "rgb.txt:3: timestamp 1.000000 repeats that of line 1; sort the list and remove "
            "duplicates");
  folder.Write("rgb.txt", "1.0 rgb/a.png\n0.5 rgb/b.png\n");
  EXPECT_THAT(Complaint(folder, "rgb.txt"),
              HasSubstr("rgb.txt:2: timestamp 0.500000 is earlier than that of line 1"));
  folder.Write("associations.txt", "2 rgb/a.png 2 depth/a.png\n1 rgb/b.png 1 depth/b.png\n");
  EXPECT_THAT(Complaint(folder, "associations.txt"), HasSubstr("associations.txt:2: timestamp"));
}

TEST(ReadTumIndex, RefusesTwoImagesOfOneTime) {
  const TestFolder folder;
  folder.Write("rgb/1.0.png", "");
  folder.Write("rgb/1.0.jpg", "");
  folder.Write("depth/1.0.png", "");
  EXPECT_THAT(Complaint(folder, "rgb/"), HasSubstr("have the same timestamp"));
}

TEST(ReadTumIndex, SaysWhenNothingIsThere) {
  const TestFolder folder;
  folder.Write("associations.txt", "# nothing\n");
  EXPECT_EQ(Complaint(folder, "associations.txt"), "associations.txt' names no image pair");
  const TestFolder lists;
  lists.Write("rgb.txt", "1.0 rgb/a.png\n");
  std::filesystem::create_directories(lists / "depth");
  EXPECT_THAT(Complaint(lists, "depth'"), HasSubstr("no PNG or JPEG image"));
  lists.Write("depth.txt", "5.0 depth/a.png\n");
  EXPECT_THAT(MessageOf([&] { ReadTumIndex(lists.path()); }),
              AllOf(HasSubstr("within 0.02 s"), HasSubstr("1.000000"), HasSubstr("5.000000")));
}

}  // namespace
}  // namespace cslam
