// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/sequence_writer.h"

#include "cslam/io/camera_file.h"
#include "cslam/io/image_codec.h"
#include "cslam/io/instance_image.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/io/truth_files.h"
#include "cslam/sim/test_scene.h"
#include "cslam/sim/world.h"
#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <filesystem>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace cslam {
namespace {

using testing::HasSubstr;

// A room in which a box vanishes and another one moves, five frames of it.
World SmallWorld() {
  World world;
  world.scene = MakeTestScene();
  SceneObject second = world.scene.objects[1];
  second.name = "carton";
  second.class_id = kNoClass;
  world.scene.objects.push_back(second);
  world.timelines[1].stays = {{.to_s = 0.05, .T_world_object = Standing(-0.3, 2.0, 0.8)}};
  world.timelines[2].stays = {{.to_s = 0.07, .T_world_object = Standing(0.3, 2.0, 0.8)},
                              {.from_s = 0.07, .T_world_object = Standing(0.5, 2.0, 0.8)}};
  return world;
}

SimulatedSequence MakeTiny(std::uint64_t seed = 1) {
  CameraMotion motion;
  motion.duration_s = 10.0;
  motion.T_world_camera = [](double time_s) {  // looks along y
    return Se3(
        Eigen::Quaterniond(Eigen::AngleAxisd(-0.5 * std::numbers::pi, Eigen::Vector3d::UnitX())),
        {0.1 * time_s, 0.0, 1.0});
  };
  return {SmallWorld(), motion, {.width = 64, .height = 48, .num_frames = 5, .seed = seed}};
}

const SimulatedSequence& TinySequence() {
  static const SimulatedSequence sequence = MakeTiny();
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
  EXPECT_EQ(one.size(), 3U * 5U + 12U);
  EXPECT_EQ(one, AllFiles(folder / "three"));
}

TEST(WriteSequence, ReportsEveryFrameOnce) {
  const TestFolder folder;
  std::vector<int> done;
  WriteSequence(TinySequence(), folder / "out", {.jobs = 2, .progress = [&](int i, int total) {
                                                   EXPECT_EQ(total, 5);
                                                   done.push_back(i);
                                                 }});
  EXPECT_EQ(done, (std::vector<int>{0, 1, 2, 3, 4, 5}));
}

TEST(WriteSequence, WritesTheTruthAboutWhatIsInTheImages) {
  const TestFolder folder;
  WriteSequence(TinySequence(), folder.path(), {});
  const TrueObjects objects = ReadTrueObjects(folder / "objects.json");
  EXPECT_EQ(objects.sequence, "simulated");
  EXPECT_NEAR(objects.duration_s, 5.0 / 30.0, 1e-9);
  ASSERT_EQ(objects.objects.size(), 2U);
  EXPECT_EQ(objects.objects[0].intervals.at(0).to_s, 0.05);
  const TrueChanges changes = ReadTrueChanges(folder / "changes.json");
  ASSERT_EQ(changes.changes.size(), 2U);
  EXPECT_EQ(changes.changes[0].kind, ChangeKind::kRemoved);
  EXPECT_EQ(changes.changes[1].kind, ChangeKind::kMoved);
  const DetectionRecord detections = ReadDetections(folder / "detections.json");
  ASSERT_EQ(detections.frames.size(), 5U);
  const cv::Mat ids = ReadInstanceImage(folder / "instances/1.000000.png");
  EXPECT_EQ(cv::norm(ids, TinySequence().Truth(0).instances, cv::NORM_INF), 0.0);
  ASSERT_EQ(detections.frames[0].detections.size(), 1U);
  EXPECT_EQ(detections.frames[0].detections[0].class_id, 56);
  EXPECT_EQ(detections.frames[0].detections[0].visible_px, cv::countNonZero(ids == 1));
  EXPECT_TRUE(detections.frames[4].detections.empty());
}

TEST(WriteSequence, RefusesAFolderInUse) {
  const TestFolder folder;
  folder.Write("out/notes.txt", "mine");
  for (const ExistingFolder existing :
       {ExistingFolder::kRefuse, ExistingFolder::kResume, ExistingFolder::kReplace}) {
    const std::string message =
        MessageOf([&] { WriteSequence(TinySequence(), folder / "out", {.existing = existing}); });
    EXPECT_THAT(message, HasSubstr("out'"));
    EXPECT_THAT(message, HasSubstr("choose another folder"));
  }
  EXPECT_EQ(AllFiles(folder / "out").size(), 1U);
}

TEST(WriteSequence, ReplacesARenderingAndNothingElse) {
  const TestFolder folder;
  WriteSequence(MakeTiny(2), folder / "out", {});
  folder.Write("out/notes.txt", "mine");
  folder.Write("out/rgb/notes.txt", "mine, too");
  folder.Write("out/rgb/9.000000.png", "of a longer rendering");
  WriteSequence(TinySequence(), folder / "out", {.existing = ExistingFolder::kReplace});
  WriteSequence(TinySequence(), folder / "fresh", {});
  auto files = AllFiles(folder / "out");
  EXPECT_EQ(files.extract("notes.txt").mapped(), "mine");
  EXPECT_EQ(files.extract("rgb/notes.txt").mapped(), "mine, too");
  EXPECT_EQ(files, AllFiles(folder / "fresh"));
}

// Stops after the third frame.
void WriteAPart(const std::filesystem::path& folder) {
  std::stop_source source;
  const WriteOutcome outcome = WriteSequence(TinySequence(), folder,
                                             {.progress =
                                                  [&](int done, int) {
                                                    if (done == 3) source.request_stop();
                                                  },
                                              .stop = source.get_token()});
  EXPECT_EQ(outcome, WriteOutcome::kStopped);
}

TEST(WriteSequence, GoesOnAfterAnInterruptionToTheSameBytes) {
  const TestFolder folder;
  WriteSequence(TinySequence(), folder / "whole", {});
  WriteAPart(folder / "out");
  // What a killed program and a full disk may leave.
  folder.Write("out/rgb/1.133333.png.tmp-77", "half a file");
  folder.Write("out/depth/1.033333.png", "");
  std::vector<int> done;
  WriteSequence(TinySequence(), folder / "out",
                {.jobs = 2, .existing = ExistingFolder::kResume, .progress = [&](int i, int) {
                   done.push_back(i);
                 }});
  EXPECT_EQ(done, (std::vector<int>{2, 3, 4, 5}));
  EXPECT_EQ(AllFiles(folder / "out"), AllFiles(folder / "whole"));
}

TEST(WriteSequence, LeavesACompleteRenderingAsItIsWhenResumed) {
  const TestFolder folder;
  WriteSequence(TinySequence(), folder.path(), {});
  folder.Write("README.txt", "annotated");
  std::vector<int> done;
  WriteSequence(
      TinySequence(), folder.path(),
      {.existing = ExistingFolder::kResume, .progress = [&](int i, int) { done.push_back(i); }});
  EXPECT_EQ(done, (std::vector<int>{5}));
  EXPECT_EQ(TestFolder::Read(folder / "README.txt"), "annotated");
}

TEST(WriteSequence, DoesNotResumeARenderingOfOtherParameters) {
  const TestFolder folder;
  WriteAPart(folder / "out");
  const auto files = AllFiles(folder / "out");
  const std::string message = MessageOf(
      [&] { WriteSequence(MakeTiny(2), folder / "out", {.existing = ExistingFolder::kResume}); });
  EXPECT_THAT(message, HasSubstr("the seed is 1 there, 2 was asked for"));
  EXPECT_EQ(AllFiles(folder / "out"), files);
}

TEST(WriteSequence, NamesTheFolderItCannotMake) {
  const TestFolder folder;
  folder.Write("file", "");
  const std::string message =
      MessageOf([&] { WriteSequence(TinySequence(), folder / "file/out", {}); });
  EXPECT_NE(message.find("file/out"), std::string::npos) << message;
}

TEST(MeasureFrameBytes, RendersAFewFramesThatTheSequenceThenKeeps) {
  const TestFolder folder;
  const SimulatedSequence& sequence = TinySequence();
  WriteSequence(sequence, folder / "whole", {});
  double bytes = 0.0;
  for (const int i : {1, 3})
    bytes += FrameBytes(folder / "whole", sequence.stamp(i)) / 2.0;
  PrepareSequenceFolder(folder / "out", DescribeSequence(sequence, "simulated"),
                        ExistingFolder::kRefuse);
  EXPECT_EQ(MeasureFrameBytes(sequence, folder / "out", 2), bytes);
  EXPECT_GT(MeasureFrameSeconds(sequence, folder / "out"), 0.0);
  std::vector<int> done;
  WriteSequence(
      sequence, folder / "out",
      {.existing = ExistingFolder::kResume, .progress = [&](int i, int) { done.push_back(i); }});
  EXPECT_EQ(done.front(), 3);
  EXPECT_EQ(AllFiles(folder / "out"), AllFiles(folder / "whole"));
}

TEST(WriteSequence, LeavesNoCompleteFolderWhenStopped) {
  const TestFolder folder;
  WriteAPart(folder / "out");
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
