// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/sequence_writer.h"

#include "cslam/io/camera_file.h"
#include "cslam/io/image_codec.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/sim/room.h"
#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace cslam {
namespace {

const SimulatedSequence& TinySequence() {
  static const SimulatedSequence sequence(MakeRoom({.texels_per_m = 60.0, .light_cell_m = 1.0}),
                                          MakeDemoPath(1),
                                          {.width = 64, .height = 48, .num_frames = 5});
  return sequence;
}

std::map<std::string, std::string> AllFiles(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files[std::filesystem::relative(entry.path(), folder).string()] =
          TestFolder::Read(entry.path());
    }
  }
  return files;
}

TEST(WriteSequence, WritesWhatTheReadersReadBack) {
  const TestFolder folder;
  const SimulatedSequence& sequence = TinySequence();
  ASSERT_EQ(WriteSequence(sequence, folder.path(), {}), WriteOutcome::kComplete);

  const CameraConfig camera = ReadCameraFile(folder / "camera.yaml");
  EXPECT_EQ(camera.camera, sequence.camera());
  EXPECT_EQ(camera.depth_units_per_m, 5000.0);
  const Trajectory truth = ReadTrajectory(folder / "groundtruth.txt");
  ASSERT_EQ(truth.size(), 5U);
  EXPECT_EQ(truth[3].stamp, sequence.stamp(3));
  EXPECT_LT(Difference(truth[3].T_world_camera, sequence.T_world_camera(3)).distance_m, 1e-6);

  const RgbdFrame frame = sequence.Frame(3);
  const std::string name = FormatStamp(sequence.stamp(3)) + ".png";
  const cv::Mat bgr = ReadColorImage(folder / ("rgb/" + name));
  EXPECT_EQ(cv::norm(bgr, frame.bgr, cv::NORM_L1), 0.0);
  const cv::Mat depth_units = ReadDepthImage(folder / ("depth/" + name));
  EXPECT_NEAR(depth_units.at<std::uint16_t>(20, 30) / 5000.0,
              static_cast<double>(frame.depth_m.at<float>(20, 30)), 0.00011);
  EXPECT_NE(TestFolder::Read(folder / "associations.txt")
                .find("1.100000 rgb/" + name + " 1.100000 depth/" + name),
            std::string::npos);
}

TEST(WriteSequence, WritesTheSameBytesWhateverTheNumberOfJobs) {
  const TestFolder folder;
  const SimulatedSequence& sequence = TinySequence();
  WriteSequence(sequence, folder / "one", {.jobs = 1});
  WriteSequence(sequence, folder / "three", {.jobs = 3});
  const auto one = AllFiles(folder / "one");
  EXPECT_EQ(one.size(), 2U * 5U + 5U);
  EXPECT_EQ(one, AllFiles(folder / "three"));
}

TEST(WriteSequence, ReportsEveryFrameOnce) {
  const TestFolder folder;
  std::vector<int> done;
  WriteSequence(TinySequence(), folder / "out", {.jobs = 2, .progress = [&](int i, int total) {
                                                   EXPECT_EQ(total, 5);
                                                   done.push_back(i);
                                                 }});
  EXPECT_EQ(done, (std::vector<int>{1, 2, 3, 4, 5}));
}

TEST(WriteSequence, RefusesAFolderInUseUnlessToldToOverwrite) {
  const TestFolder folder;
  folder.Write("out/notes.txt", "mine");
  const std::string message = MessageOf([&] { WriteSequence(TinySequence(), folder / "out", {}); });
  EXPECT_NE(message.find("out' exists and is not an empty folder"), std::string::npos) << message;
  EXPECT_EQ(WriteSequence(TinySequence(), folder / "out", {.existing = ExistingFolder::kOverwrite}),
            WriteOutcome::kComplete);
  EXPECT_EQ(TestFolder::Read(folder / "out/notes.txt"), "mine");
}

TEST(WriteSequence, NamesTheFolderItCannotMake) {
  const TestFolder folder;
  folder.Write("file", "");
  const std::string message =
      MessageOf([&] { WriteSequence(TinySequence(), folder / "file/out", {}); });
  EXPECT_NE(message.find("file/out"), std::string::npos) << message;
}

TEST(WriteSequence, LeavesNoCompleteFolderWhenStopped) {
  const TestFolder folder;
  std::stop_source source;
  const WriteOutcome outcome = WriteSequence(TinySequence(), folder / "out",
                                             {.progress =
                                                  [&](int done, int) {
                                                    if (done == 2) source.request_stop();
                                                  },
                                              .stop = source.get_token()});
  EXPECT_EQ(outcome, WriteOutcome::kStopped);
  EXPECT_FALSE(std::filesystem::exists(folder / "out/camera.yaml"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out/rgb.txt"));
}

TEST(WriteSequence, PassesOnWhatGoesWrongInAThread) {
  const TestFolder folder;
  const std::string message = MessageOf([&] {
    WriteSequence(TinySequence(), folder / "out",
                  {.jobs = 2, .progress = [](int, int) { throw Error("the progress bar broke"); }});
  });
  EXPECT_EQ(message, "the progress bar broke");
}

}  // namespace
}  // namespace cslam
