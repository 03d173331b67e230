// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/point_cloud_file.h"

#include "cslam/util/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

namespace cslam {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class WritePointCloudTest : public testing::Test {
 protected:
  ~WritePointCloudTest() override { std::filesystem::remove(path_); }

  // Header up to and including "end_header\n", and the bytes after it.
  std::pair<std::string, std::string> Written() const {
    std::ifstream file(path_, std::ios::binary);
    const std::string all((std::istreambuf_iterator<char>(file)), {});
    const std::string end = "end_header\n";
    const std::size_t split = all.find(end) + end.size();
    return {all.substr(0, split), all.substr(split)};
  }

  const std::filesystem::path path_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("cslam_") + testing::UnitTest::GetInstance()->current_test_info()->name() +
       ".ply");
};

TEST_F(WritePointCloudTest, WritesHeaderAndPackedPoints) {
  const std::vector<ColoredPoint> points = {{{1.0F, -2.5F, 3.25F}, {255, 128, 0}},
                                            {{0.0F, 0.0F, 1e-3F}, {1, 2, 3}}};
  WritePointCloud(path_, points, "map\nworld frame");

  const auto [header, body] = Written();
  EXPECT_THAT(header, StartsWith("ply\nformat binary_little_endian 1.0\ncomment map\n"
                                 "comment world frame\nelement vertex 2\nproperty float x\n"));
  ASSERT_EQ(body.size(), 2u * 15u);
  std::array<float, 3> position{};
  std::memcpy(position.data(), body.data(), 12);
  EXPECT_EQ(position, (std::array<float, 3>{1.0F, -2.5F, 3.25F}));
  EXPECT_EQ(body.substr(12, 3), std::string("\xFF\x80\x00", 3));
  EXPECT_EQ(body.substr(27, 3), "\x01\x02\x03");
}

TEST_F(WritePointCloudTest, LeavesOutPointsThatAreNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  WritePointCloud(path_, std::vector<ColoredPoint>{{{nan, 0.0F, 0.0F}, {}}, {}, {}});
  const auto [header, body] = Written();
  EXPECT_THAT(header, HasSubstr("element vertex 2\n"));
  EXPECT_EQ(body.size(), 30u);
}

TEST_F(WritePointCloudTest, WritesAnEmptyCloudWhenThereAreNoPoints) {
  WritePointCloud(path_, {});
  const auto [header, body] = Written();
  EXPECT_THAT(header, HasSubstr("element vertex 0\n"));
  EXPECT_TRUE(body.empty());
}

TEST_F(WritePointCloudTest, ThrowsWhenTheFolderDoesNotExist) {
  EXPECT_THROW(WritePointCloud("/no/such/folder/map.ply", {}), Error);
}

}  // namespace
}  // namespace cslam
