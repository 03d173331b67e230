// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/trajectory_file.h"

#include "cslam/util/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <string>

namespace cslam {
namespace {

using ::testing::HasSubstr;

std::string ErrorOf(std::string_view text) {
  try {
    ParseTrajectory(text, "est.txt");
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(ParseTrajectory, ReadsFieldsInTumOrderWhenLinesAreMixed) {
  const Trajectory trajectory = ParseTrajectory(
      "\xEF\xBB\xBF# timestamp tx ty tz qx qy qz qw\r\n"
      "\n"
      "1305031453.359684 1 2 3 1 0 0 0\r\n"
      "  1305031453.391690\t-1.5e-1 +0.25 0 0 0 0.6 0.8",
      "est.txt");

  ASSERT_EQ(trajectory.size(), 2u);
  EXPECT_EQ(trajectory[0].stamp.ns, 1305031453359684000);
  EXPECT_EQ(trajectory[0].T_world_camera.translation, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_DOUBLE_EQ(trajectory[0].T_world_camera.rotation.x(), 1.0);
  EXPECT_EQ(trajectory[1].T_world_camera.translation, Eigen::Vector3d(-0.15, 0.25, 0.0));
  EXPECT_DOUBLE_EQ(trajectory[1].T_world_camera.rotation.z(), 0.6);
  EXPECT_DOUBLE_EQ(trajectory[1].T_world_camera.rotation.w(), 0.8);
}

TEST(ParseTrajectory, NormalisesTheQuaternionWhenItIsRounded) {
  const Trajectory trajectory = ParseTrajectory("1 0 0 0 0.71 0 0 0.71\n", "est.txt");
  EXPECT_NEAR(trajectory.at(0).T_world_camera.rotation.norm(), 1.0, 1e-15);
}

TEST(ParseTrajectory, IsEmptyWhenThereAreOnlyComments) {
  EXPECT_TRUE(ParseTrajectory("# nothing\n\n", "est.txt").empty());
  EXPECT_TRUE(ParseTrajectory("", "est.txt").empty());
}

TEST(ParseTrajectory, NamesFileAndLineWhenALineIsBroken) {
  const std::string good = "# comment\n1 0 0 0 0 0 0 1\n";
  EXPECT_THAT(ErrorOf(good + "2 0 0 0 0 0 1\n"), HasSubstr("est.txt:3: expected 8 numbers"));
  EXPECT_THAT(ErrorOf(good + "2 0 0 0 0 0 0 1 9\n"), HasSubstr("found 9 fields"));
  EXPECT_THAT(ErrorOf(good + "2,0,0,0,0,0,0,1\n"), HasSubstr("separate them by blanks"));
  EXPECT_THAT(ErrorOf(good + "two 0 0 0 0 0 0 1\n"), HasSubstr("'two' is not a timestamp"));
  EXPECT_THAT(ErrorOf(good + "2 0 0 x1 0 0 0 1\n"), HasSubstr("'x1' is not a finite number"));
  EXPECT_THAT(ErrorOf(good + "2 0 0 1m 0 0 0 1\n"), HasSubstr("'1m' is not a finite number"));
}

TEST(ParseTrajectory, NamesFileAndLineWhenAValueIsNotFinite) {
  EXPECT_THAT(ErrorOf("2 nan 0 0 0 0 0 1\n"), HasSubstr("est.txt:1: 'nan' is not a finite"));
  EXPECT_THAT(ErrorOf("2 0 0 inf 0 0 0 1\n"), HasSubstr("'inf' is not a finite"));
  EXPECT_THAT(ErrorOf("2 0 0 1e999 0 0 0 1\n"), HasSubstr("'1e999' is not a finite"));
  EXPECT_THAT(ErrorOf("nan 0 0 0 0 0 0 1\n"), HasSubstr("'nan' is not a timestamp"));
}

TEST(ParseTrajectory, NamesFileAndLineWhenTheQuaternionIsNotUnit) {
  EXPECT_THAT(ErrorOf("1 0 0 0 0 0 0 0\n"), HasSubstr("est.txt:1: quaternion qx qy qz qw has"));
  EXPECT_THAT(ErrorOf("1 0 0 0 0 0 0 1.02\n"), HasSubstr("length 1.02 instead of 1"));
  EXPECT_EQ(ErrorOf("1 0 0 0 0 0 0 1.005\n"), "no error");
}

TEST(ParseTrajectory, NamesBothLinesWhenTimeDoesNotIncrease) {
  EXPECT_THAT(ErrorOf("1.5 0 0 0 0 0 0 1\n#\n1.50 0 0 0 0 0 0 1\n"),
              HasSubstr("est.txt:3: timestamp 1.50 repeats line 1"));
  EXPECT_THAT(ErrorOf("1.5 0 0 0 0 0 0 1\n1.4 0 0 0 0 0 0 1\n"),
              HasSubstr("est.txt:2: timestamp 1.4 comes before that of line 1"));
}

TEST(ReadTrajectory, NamesThePathWhenItCannotBeRead) {
  const auto message = [](const std::filesystem::path& path) -> std::string {
    try {
      ReadTrajectory(path);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(message("/no/such/file.txt"),
            "cannot read trajectory '/no/such/file.txt': No such file or directory");
  EXPECT_THAT(message(testing::TempDir()), HasSubstr("directory"));
}

TEST(FormatTrajectory, WritesSixDecimalsOfTimeAndOneSpellingOfARotation) {
  const Trajectory trajectory = {
      {Stamp{1305031453359684000}, Se3({-0.8, 0.0, 0.0, 0.6}, {1.0, -2.0, 0.12345678})}};
  EXPECT_EQ(FormatTrajectory(trajectory, "first\nsecond"),
            "# first\n# second\n"
            "1305031453.359684 1.0000000 -2.0000000 0.1234568 "
            "-0.000000000 -0.000000000 -0.600000000 0.800000000\n");
}

TEST(FormatTrajectory, IsABugWhenAPoseIsNotFiniteOrStampsDoNotIncrease) {
  const Se3 identity;
  Se3 broken;
  broken.translation.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(FormatTrajectory({{Stamp{1}, broken}}), InternalError);
  EXPECT_THROW(FormatTrajectory({{Stamp{1}, identity}, {Stamp{1}, identity}}), InternalError);
}

TEST(WriteTrajectory, ReadsBackWithinTheWrittenDecimals) {
  const auto path = std::filesystem::path(testing::TempDir()) / "cslam_trajectory_round_trip.txt";
  Trajectory written;
  for (int i = 0; i < 50; ++i) {
    Vector6 tangent;
    tangent << 0.05 * i, -0.02 * i, 0.01 * i, 0.3 * i, 1.0, -0.1 * i;
    written.push_back({Stamp{1'000'000'000'000 + 33'333'000LL * i}, Exp(tangent)});
  }

  WriteTrajectory(path, written, "timestamp tx ty tz qx qy qz qw");
  const Trajectory read = ReadTrajectory(path);
  std::filesystem::remove(path);

  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].stamp, written[i].stamp);
    const PoseDifference difference = Difference(written[i].T_world_camera, read[i].T_world_camera);
    EXPECT_LT(difference.distance_m, 1e-7);
    EXPECT_LT(difference.angle_rad, 2e-9);
  }
}

TEST(WriteTrajectory, ThrowsWhenTheFolderDoesNotExist) {
  EXPECT_THROW(WriteTrajectory("/no/such/folder/trajectory.txt", {}), Error);
}

}  // namespace
}  // namespace cslam
