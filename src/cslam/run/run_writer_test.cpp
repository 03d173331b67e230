// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/run_writer.h"

#include "cslam/io/config.h"
#include "cslam/run/map_cloud.h"
#include "cslam/run/run_summary.h"
#include "cslam/run/test_dataset.h"
#include "cslam/util/options.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace cslam {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

constexpr int kNumFrames = 20;
constexpr RunSettings kInline = {.execution = Execution::kInline, .rate = PlayRate::kMax};
const std::vector<std::string>& RepeatableFiles() {
  static const std::vector<std::string> kFiles = {
      "trajectory.txt", "trajectory_live.txt", "keyframes.txt", "loops.json",
      "map.ply",        "grid.yaml",           "grid.pgm",      "config.yaml",
      "trajectory.svg", "objects.json",        "changes.json"};
  return kFiles;
}

struct FinishedRun {
  RunOutcome outcome;
  RunTrajectories trajectories;
  RunReport report;
};

FinishedRun RunInto(const fs::path& folder, const MemoryDataset& dataset) {
  FinishedRun run;
  run.outcome = RunSequence(dataset, SlamOptions(), kInline, {}, [] { return false; });
  run.trajectories = ExtractTrajectories(run.outcome.result);
  run.report = MakeReport({.version = "1.2.3",
                           .commit = "abc",
                           .arguments = {"run", "room"},
                           .sequence = "data/room/",
                           .folder = folder,
                           .settings = kInline},
                          dataset, run.outcome, run.trajectories);
  return run;
}

void Write(const FinishedRun& run, const MemoryDataset& dataset) {
  WriteRunFolder(run.report, run.outcome, run.trajectories, dataset, SlamOptions());
}

std::set<std::string> FilesIn(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

class RunWriterTest : public testing::Test {
 protected:
  TestFolder folder_;
  MemoryDataset dataset_ = RenderedDataset();
};

TEST_F(RunWriterTest, WritesEveryFileAndNoOther) {
  const FinishedRun run = RunInto(folder_.path(), dataset_);
  Write(run, dataset_);
  EXPECT_EQ(
      FilesIn(folder_.path()),
      (std::set<std::string>{"trajectory.txt", "trajectory_live.txt", "keyframes.txt", "frames.csv",
                             "loops.json", "map.ply", "config.yaml", "run.json", "trajectory.svg",
                             "grid.yaml", "grid.pgm", "objects.json", "changes.json"}));
  const Trajectory poses = ReadTrajectory(folder_ / "trajectory.txt");
  ASSERT_EQ(poses.size(), static_cast<std::size_t>(kNumFrames));
  EXPECT_EQ(FormatStamp(poses[3].stamp), FormatStamp(dataset_.stamp(3)));
  EXPECT_EQ(ReadTrajectory(folder_ / "keyframes.txt").size(), run.report.map.keyframes);
  const std::string csv = TestFolder::Read(folder_ / "frames.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), kNumFrames + 1);
  SlamOptions options;
  OptionList list;
  Describe(list, options);
  EXPECT_NO_THROW(LoadYaml(folder_ / "config.yaml", list));
}

TEST_F(RunWriterTest, GivesEqualBytesOnEveryRun) {
  dataset_.WriteGroundTruth(folder_ / "groundtruth.txt");
  std::vector<std::vector<std::string>> runs;
  for (const char* const name : {"first", "second"}) {
    PrepareRunFolder(folder_ / name);
    Write(RunInto(folder_ / name, dataset_), dataset_);
    auto& contents = runs.emplace_back();
    for (const std::string& file : RepeatableFiles())
      contents.push_back(TestFolder::Read(folder_ / name / file));
  }
  for (std::size_t i = 0; i < RepeatableFiles().size(); ++i) {
    EXPECT_FALSE(runs[0][i].empty()) << RepeatableFiles()[i];
    EXPECT_EQ(runs[0][i], runs[1][i]) << RepeatableFiles()[i];
  }
}

TEST_F(RunWriterTest, WritesTheOtherFilesButNoRunJsonWhenOneCannotBeWritten) {
  fs::create_directories(folder_ / "map.ply" / "in the way");
  const FinishedRun run = RunInto(folder_.path(), dataset_);
  EXPECT_THAT(MessageOf([&] { Write(run, dataset_); }), HasSubstr("map.ply"));
  const auto files = FilesIn(folder_.path());
  EXPECT_TRUE(files.contains("trajectory.txt") && files.contains("trajectory.svg"));
  EXPECT_FALSE(files.contains("run.json"));
}

TEST_F(RunWriterTest, WritesTheFolderWhenNothingWasTracked) {
  dataset_.RemoveDepth();
  dataset_.WriteGroundTruth(folder_ / "groundtruth.txt");
  const FinishedRun run = RunInto(folder_ / "out", dataset_);
  PrepareRunFolder(folder_ / "out");
  Write(run, dataset_);
  EXPECT_EQ(FilesIn(folder_ / "out").size(), 11U) << "all but the grid";
  EXPECT_TRUE(ReadTrajectory(folder_ / "out" / "trajectory.txt").empty());
  EXPECT_THAT(FormatRunSummary(run.report), HasSubstr("0.0 % (0 of 20)"));
}

TEST_F(RunWriterTest, TakesPointColoursFromTheImages) {
  const FinishedRun run = RunInto(folder_.path(), dataset_);
  const auto cloud = ColourMap(run.outcome.result, dataset_);
  ASSERT_EQ(cloud.size(), run.report.map.points);
  const std::array<std::uint8_t, 3> grey = {128, 128, 128};
  const auto is_grey = [&](const ColoredPoint& point) { return point.rgb == grey; };
  EXPECT_LT(std::count_if(cloud.begin(), cloud.end(), is_grey),
            static_cast<std::ptrdiff_t>(cloud.size() / 10));
}

TEST_F(RunWriterTest, LeavesPointsGreyWhenTheImagesAreGone) {
  const FinishedRun run = RunInto(folder_.path(), dataset_);
  for (std::size_t i = 0; i < dataset_.size(); ++i)
    dataset_.MakeUnreadable(i);
  for (const ColoredPoint& point : ColourMap(run.outcome.result, dataset_))
    EXPECT_EQ(point.rgb[0], 128);
}

TEST_F(RunWriterTest, SummarisesAccuracyOnlyWhereThereIsGroundTruth) {
  EXPECT_THAT(FormatRunSummary(RunInto(folder_.path(), dataset_).report), Not(HasSubstr("ATE")));
  dataset_.WriteGroundTruth(folder_ / "groundtruth.txt");
  const FinishedRun run = RunInto(folder_.path(), dataset_);
  const std::string summary = FormatRunSummary(run.report);
  for (const char* const row : {"frames", "tracked", "keyframes", "points", "ATE", "ATE, live",
                                "RPE", "path length", "real time", "memory", "local_ba"})
    EXPECT_THAT(summary, HasSubstr(row));
  EXPECT_THAT(summary, HasSubstr(folder_.path().string()));
  EXPECT_LT(run.report.accuracy.final_poses.ate.value().statistics_m.rmse, 0.01);
}

TEST(PrepareRunFolder, RefusesAFolderBelowAFile) {
  const TestFolder folder;
  folder.Write("file", "");
  EXPECT_THAT(MessageOf([&] { PrepareRunFolder(folder / "file" / "out"); }), HasSubstr("file/out"));
}

TEST(PrepareRunFolder, RefusesAFolderThatTakesNoFiles) {
  EXPECT_THROW(PrepareRunFolder("/proc/self"), Error);
}

TEST(PrepareRunFolder, MakesFoldersAndRemovesTheMarkOfAnEarlierRun) {
  const TestFolder folder;
  PrepareRunFolder(folder / "a" / "b");
  folder.Write("a/b/run.json", "{}");
  folder.Write("a/b/notes.txt", "mine");
  PrepareRunFolder(folder / "a" / "b");
  EXPECT_EQ(FilesIn(folder / "a" / "b"), std::set<std::string>{"notes.txt"});
}

TEST(SequenceName, IsTheLastFolderOfThePath) {
  EXPECT_EQ(SequenceName("data/desk"), "desk");
  EXPECT_EQ(SequenceName("data/desk/"), "desk");
  EXPECT_EQ(SequenceName("data/desk/../room/."), "room");
}

}  // namespace
}  // namespace cslam
