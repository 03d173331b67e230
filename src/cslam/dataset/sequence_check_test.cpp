// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/dataset/sequence_check.h"

#include "cslam/dataset/sequence_writer.h"
#include "cslam/dataset/test_story.h"
#include "cslam/io/image_codec.h"
#include "cslam/io/instance_image.h"
#include "cslam/io/test_sequence.h"
#include "cslam/io/trajectory_file.h"
#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace cslam {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// The story of test_story.h on disk, written once; each test spoils a copy.
class CheckSequenceTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    original_ = new TestFolder();
    WriteSequence(test::MakeStory(), original_->path(), {.existing = ExistingFolder::kReplace});
  }
  static void TearDownTestSuite() {
    delete original_;
    original_ = nullptr;
  }

  CheckSequenceTest() { fs::copy(original_->path(), folder_.path(), fs::copy_options::recursive); }

  SequenceCheck Check() const { return CheckSequence(folder_.path(), {.num_samples = 12}); }

  std::vector<fs::path> Images(const char* kind) const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder_ / kind))
      files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
  }

  template <typename Value>
  void Edit(const char* name, Value (*read)(const fs::path&),
            void (*write)(const fs::path&, const Value&),
            const std::function<void(Value&)>& edit) const {
    Value value = read(folder_ / name);
    edit(value);
    write(folder_ / name, value);
  }
  void EditObjects(const std::function<void(TrueObjects&)>& edit) const {
    Edit<TrueObjects>("objects.json", ReadTrueObjects, WriteTrueObjects, edit);
  }
  void EditChanges(const std::function<void(TrueChanges&)>& edit) const {
    Edit<TrueChanges>("changes.json", ReadTrueChanges, WriteTrueChanges, edit);
  }
  void EditDetections(const std::function<void(DetectionRecord&)>& edit) const {
    Edit<DetectionRecord>("detections.json", ReadDetections, WriteDetections, edit);
  }
  void EditRecord(const std::function<void(RenderRecord&)>& edit) const {
    Edit<RenderRecord>("render.json", ReadRenderRecord, WriteRenderRecord, edit);
  }

  TestFolder folder_;

 private:
  static TestFolder* original_;
};

TestFolder* CheckSequenceTest::original_ = nullptr;

TEST_F(CheckSequenceTest, PassesATrueSequenceAndProvesItsStory) {
  const SequenceCheck check = Check();
  EXPECT_THAT(check.errors, IsEmpty());
  EXPECT_THAT(check.warnings, IsEmpty());
  EXPECT_THAT(check.skipped, IsEmpty());
  ASSERT_TRUE(check.reprojection);
  EXPECT_GT(check.reprojection->all.num_points, 10'000U);
  EXPECT_LT(check.reprojection->all.p95_m, 0.001);
  ASSERT_TRUE(check.truth);
  EXPECT_EQ(check.truth->num_frames, 12U);
  ASSERT_TRUE(check.story);
  EXPECT_EQ(check.story->changes.size(), 4U);
  ASSERT_TRUE(check.story->people);
  EXPECT_GT(check.story->people->peak_share, 0.1);
}

TEST_F(CheckSequenceTest, SeesAWrongDepthScale) {
  std::string camera = TestFolder::Read(folder_ / "camera.yaml");
  camera.replace(camera.find("5000"), 4, "5100");
  folder_.Write("camera.yaml", camera);
  EXPECT_THAT(Check().errors, Contains(HasSubstr("times what the noise allows")));
}

TEST_F(CheckSequenceTest, SeesSwappedPoses) {
  Trajectory poses = ReadTrajectory(folder_ / "groundtruth.txt");
  std::swap(poses[0].T_world_camera, poses[12].T_world_camera);
  WriteTrajectory(folder_ / "groundtruth.txt", poses);
  EXPECT_THAT(Check().errors, Contains(HasSubstr("frames 0 and 2 disagree")));
}

TEST_F(CheckSequenceTest, SeesAMissingInstanceImage) {
  fs::remove(Images("instances").front());
  EXPECT_THAT(Check().errors, Contains(HasSubstr("frame 0: the instance image is missing")));
}

TEST_F(CheckSequenceTest, SeesChangedInstancePixels) {
  const fs::path file = Images("instances").front();
  cv::Mat image = ReadInstanceImage(file);
  image.at<std::uint16_t>(0, 0) = test::kBear;
  WriteInstanceImage(file, image, 9);
  EXPECT_THAT(Check().errors, Contains(AllOf(HasSubstr("frame 0"), HasSubstr("instance 2"))));
}

TEST_F(CheckSequenceTest, SeesABoxOffByOne) {
  EditDetections([](DetectionRecord& r) { r.frames[0].detections[0].box.y_max -= 1.0; });
  EXPECT_THAT(Check().errors, ElementsAre(AllOf(HasSubstr("frame 0"), HasSubstr("the box of"))));
}

TEST_F(CheckSequenceTest, SeesAChangeThatTheObjectsDoNotShow) {
  EditChanges([](TrueChanges& c) { c.changes[0].time_s -= 0.5; });
  EXPECT_THAT(Check().errors, Contains(HasSubstr("do not show it")));
}

TEST_F(CheckSequenceTest, SeesAChangeInView) {
  EditChanges([](TrueChanges& c) { c.changes[0].time_s = 1.0; });
  EXPECT_THAT(Check().errors, Contains(HasSubstr("sees it happen")));
}

TEST_F(CheckSequenceTest, SeesPeopleThatFillLessThanClaimed) {
  EditRecord([](RenderRecord& r) { r.people.min_mean_share = 0.5; });
  EXPECT_THAT(Check().errors, ElementsAre(AllOf(HasSubstr("people fill"), HasSubstr("50.0 %"))));
}

TEST_F(CheckSequenceTest, TellsMalformedJsonWithItsPlaceAndGoesOn) {
  folder_.Write("objects.json", "{\n\"format\": ,\n");
  const SequenceCheck check = Check();
  EXPECT_THAT(check.errors, Contains(HasSubstr("objects.json:2")));
  EXPECT_THAT(check.skipped, Contains(HasSubstr("story not checked")));
  EXPECT_TRUE(check.reprojection);
}

TEST_F(CheckSequenceTest, SaysWhatItSkippedWithoutTruthFiles) {
  for (const char* name : {"objects.json", "changes.json", "detections.json", "render.json"})
    fs::remove(folder_ / name);
  fs::remove_all(folder_ / "instances");
  const SequenceCheck check = Check();
  EXPECT_THAT(check.errors, IsEmpty());
  EXPECT_THAT(check.skipped, ElementsAre(HasSubstr("truth not checked"),
                                         HasSubstr("no objects.json: story not checked")));
  EXPECT_FALSE(check.tolerance) << "a recording, for all that is known";
  EXPECT_TRUE(check.reprojection);
}

TEST_F(CheckSequenceTest, DoesNotJudgeDepthWithoutPoses) {
  fs::remove(folder_ / "groundtruth.txt");
  const SequenceCheck check = Check();
  EXPECT_THAT(check.skipped, Contains(HasSubstr("no groundtruth.txt")));
  EXPECT_FALSE(check.reprojection);
}

TEST_F(CheckSequenceTest, PrefersThePosesOfTheCamera) {
  fs::copy(folder_ / "groundtruth.txt", folder_ / "groundtruth_camera.txt");
  Trajectory poses = ReadTrajectory(folder_ / "groundtruth.txt");
  for (StampedPose& pose : poses)
    pose.T_world_camera = pose.T_world_camera * Standing(0.0, 0.0, 0.0, 0.5);
  WriteTrajectory(folder_ / "groundtruth.txt", poses);
  const SequenceCheck check = Check();
  EXPECT_EQ(check.pose_file, "groundtruth_camera.txt");
  EXPECT_THAT(check.errors, IsEmpty());
}

TEST_F(CheckSequenceTest, WarnsOnlyOfARecordingWhosePosesDoNotFit) {
  for (const char* name : {"objects.json", "changes.json", "detections.json", "render.json"})
    fs::remove(folder_ / name);
  fs::remove_all(folder_ / "instances");
  Trajectory poses = ReadTrajectory(folder_ / "groundtruth.txt");
  for (std::size_t i = 0; i < poses.size(); ++i)
    poses[i].T_world_camera.translation.y() += 0.4 * static_cast<double>(i % 3);
  WriteTrajectory(folder_ / "groundtruth.txt", poses);
  const SequenceCheck check = Check();
  EXPECT_THAT(check.errors, IsEmpty());
  EXPECT_THAT(check.warnings, Contains(HasSubstr("the poses of groundtruth.txt disagree")));
}

TEST_F(CheckSequenceTest, AgreesWithTruthWrittenByHand) {
  const TrueObjects objects = ReadTrueObjects(folder_ / "objects.json");
  EXPECT_THAT(CheckChanges(objects, test::StoryChanges()), IsEmpty());
}

TEST(CheckSequence, PassesNoisyAndTruncatedSequences) {
  for (const SensorNoise noise : {SensorNoise::kKinect, SensorNoise::kD435i}) {
    const TestFolder folder;
    const SimulatedSequence sequence(
        test::MakeStoryWorld(),
        {.duration_s = test::kStoryDurationS, .T_world_camera = test::StoryCamera},
        {.width = 160, .height = 120, .fps = 10.0, .num_frames = 33, .noise = noise});
    RenderRecord record = DescribeSequence(sequence, "story");
    record.story_duration_s = test::kStoryDurationS;
    record.people.min_mean_share = 0.5;
    WriteSequence(sequence, record, folder.path(), {.existing = ExistingFolder::kReplace});
    const SequenceCheck check = CheckSequence(folder.path(), {.num_samples = 12});
    EXPECT_THAT(check.errors, IsEmpty()) << NameOf(noise);
    EXPECT_THAT(check.warnings, Contains(HasSubstr("the story is cut")));
    EXPECT_THAT(check.skipped, ElementsAre(HasSubstr("the story is cut")));
    ASSERT_TRUE(check.reprojection);
    EXPECT_GT(check.reprojection->all.num_points, 1'000U) << NameOf(noise);
    EXPECT_GT(check.reprojection->all.p95_per_tolerance, 0.2) << NameOf(noise);
  }
}

TEST(CheckSequence, TellsWhatTheFileCheckFindsToo) {
  const TestSequence sequence(4);
  fs::remove(sequence.Color(1));
  const SequenceCheck check = CheckSequence(sequence.path());
  EXPECT_THAT(check.errors, ElementsAre(HasSubstr("frame 1:")));
}

TEST(CheckSequence, TellsABrokenListOnce) {
  const TestSequence sequence(2);
  sequence.folder().Write("associations.txt", "0.0 rgb/0.png\n");
  EXPECT_THAT(CheckSequence(sequence.path()).errors, ElementsAre(HasSubstr("associations.txt:1")));
}

TEST(CheckSequence, RefusesWhatIsNoDataset) {
  const TestFolder folder;
  EXPECT_THROW(CheckSequence(folder.path()), Error);
}

}  // namespace
}  // namespace cslam
