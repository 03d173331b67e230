// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/truth_files.h"

#include "cslam/io/test_broken_file.h"
#include "cslam/util/check.h"
#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <string_view>

namespace cslam {
namespace {

using testing::HasSubstr;

Se3 SomePose(double x) {
  return {Eigen::Quaterniond(0.5, -0.5, 0.5, 0.5), {x, -0.25, 1.0 / 3.0}};
}

void ExpectSamePose(const Se3& a, const Se3& b) {
  EXPECT_LT(Difference(a, b).distance_m, 2e-9);
  EXPECT_LT(Difference(a, b).angle_rad, 1e-7);
}

DetectionRecord SomeDetections() {
  DetectionRecord record{.sequence = "a \"b\"", .width_px = 64, .height_px = 48, .frames = {}};
  RecordedFrame frame{.stamp = Stamp{1'000'000'000}, .detections = {}};
  frame.detections.push_back(
      {.instance = 3, .class_id = 56, .score = 1.0, .box = {1, 2, 30, 40}, .visible_px = 700});
  frame.detections.push_back(
      {.instance = 0, .class_id = 0, .score = 0.25, .box = {-1.5, 2, 30.25, 50}, .visible_px = 0});
  record.frames.push_back(frame);
  record.frames.push_back({.stamp = Stamp{1'033'333'000}, .detections = {}});
  record.frames.push_back({.stamp = Stamp{1'305'031'453'359'684'123}, .detections = {}});
  return record;
}

TrueObjects SomeObjects() {
  TrueObject chair{.instance = 2, .name = "chair", .class_id = 56};
  chair.box_center = {0.0, 0.0, 0.45};
  chair.box_size_m = {0.5, 0.6, 0.9};
  chair.intervals.push_back(
      {.from_s = 0.0, .to_s = 2.5, .is_moving = false, .poses = {{0.0, SomePose(1.0)}}});
  chair.intervals.push_back({.from_s = 2.5,
                             .to_s = 2.7,
                             .is_moving = true,
                             .poses = {{2.5, SomePose(1.0)}, {2.6, SomePose(2.0)}}});
  TrueObject person{.instance = 7, .name = "anna", .class_id = 0, .is_deformable = true};
  return {.sequence = "demo",
          .duration_s = 20.0,
          .start = Stamp{1'000'000'000},
          .objects = {chair, person}};
}

TrueChanges SomeChanges() {
  TrueChanges changes{.sequence = "demo", .changes = {}};
  TrueChange moved{.kind = ChangeKind::kMoved, .time_s = 1.5, .instance = 2, .class_id = 56};
  moved.from = SomePose(1.0);
  moved.to = SomePose(2.0);
  moved.is_carried_in_view = true;
  TrueChange removed{.kind = ChangeKind::kRemoved, .time_s = 3.0, .instance = 2, .class_id = 56};
  removed.from = SomePose(2.0);
  TrueChange added{.kind = ChangeKind::kAdded, .time_s = 3.0, .instance = 4, .class_id = -1};
  added.to = SomePose(3.0);
  TrueChange replaced{.kind = ChangeKind::kReplaced,
                      .time_s = 9.0,
                      .instance = 4,
                      .class_id = -1,
                      .new_instance = 5,
                      .new_class_id = 25};
  replaced.from = SomePose(3.0);
  replaced.to = SomePose(3.25);
  changes.changes = {moved, removed, added, replaced};
  return changes;
}

TEST(Detections, ReadBackAsWritten) {
  const TestFolder folder;
  const DetectionRecord record = SomeDetections();
  WriteDetections(folder / "detections.json", record);
  const DetectionRecord read = ReadDetections(folder / "detections.json");
  EXPECT_EQ(read.sequence, record.sequence);
  EXPECT_EQ(read.width_px, 64);
  EXPECT_EQ(read.height_px, 48);
  EXPECT_TRUE(read.frames == record.frames) << TestFolder::Read(folder / "detections.json");
}

TEST(TrueObjects, ReadBackAsWritten) {
  const TestFolder folder;
  const TrueObjects objects = SomeObjects();
  WriteTrueObjects(folder / "objects.json", objects);
  const TrueObjects read = ReadTrueObjects(folder / "objects.json");
  EXPECT_EQ(read.sequence, "demo");
  EXPECT_EQ(read.duration_s, 20.0);
  EXPECT_EQ(read.start, objects.start);
  ASSERT_EQ(read.objects.size(), 2U);
  const TrueObject& chair = read.objects[0];
  EXPECT_EQ(chair.instance, 2);
  EXPECT_EQ(chair.name, "chair");
  EXPECT_EQ(chair.class_id, 56);
  EXPECT_FALSE(chair.is_deformable);
  EXPECT_EQ(chair.box_center, objects.objects[0].box_center);
  EXPECT_EQ(chair.box_size_m, objects.objects[0].box_size_m);
  ASSERT_EQ(chair.intervals.size(), 2U);
  EXPECT_EQ(chair.intervals[0].to_s, 2.5);
  EXPECT_TRUE(chair.intervals[1].is_moving);
  ASSERT_EQ(chair.intervals[1].poses.size(), 2U);
  EXPECT_EQ(chair.intervals[1].poses[1].time_s, 2.6);
  ExpectSamePose(chair.intervals[1].poses[1].T_world_object, SomePose(2.0));
  EXPECT_TRUE(read.objects[1].is_deformable);
  EXPECT_TRUE(read.objects[1].intervals.empty());
}

TEST(TrueChanges, ReadBackAsWritten) {
  const TestFolder folder;
  const TrueChanges changes = SomeChanges();
  WriteTrueChanges(folder / "changes.json", changes);
  const TrueChanges read = ReadTrueChanges(folder / "changes.json");
  ASSERT_EQ(read.changes.size(), changes.changes.size());
  for (std::size_t i = 0; i < changes.changes.size(); ++i) {
    const TrueChange& a = read.changes[i];
    const TrueChange& b = changes.changes[i];
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.time_s, b.time_s);
    EXPECT_EQ(a.instance, b.instance);
    EXPECT_EQ(a.class_id, b.class_id);
    EXPECT_EQ(a.new_instance, b.new_instance);
    EXPECT_EQ(a.new_class_id, b.new_class_id);
    EXPECT_EQ(a.is_carried_in_view, b.is_carried_in_view);
    ASSERT_EQ(a.from.has_value(), b.from.has_value());
    if (a.from) ExpectSamePose(*a.from, *b.from);
    ASSERT_EQ(a.to.has_value(), b.to.has_value());
    if (a.to) ExpectSamePose(*a.to, *b.to);
  }
}

TEST(WriteDetections, RefusesWhatJsonCannotSay) {
  const TestFolder folder;
  DetectionRecord record = SomeDetections();
  record.frames[0].detections[0].score = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(WriteDetections(folder / "detections.json", record), InternalError);
  EXPECT_FALSE(std::filesystem::exists(folder / "detections.json"));
}

// What the readers say to a good file with a text in it replaced.
class BrokenFile : public testing::Test {
 protected:
  std::string Problem(std::string_view file, std::string_view what, std::string_view by) {
    Write();
    return test::ProblemOf(folder_ / file, what, by, Read);
  }

 private:
  void Write() const {
    WriteDetections(folder_ / "detections.json", SomeDetections());
    WriteTrueObjects(folder_ / "objects.json", SomeObjects());
    WriteTrueChanges(folder_ / "changes.json", SomeChanges());
  }
  static void Read(const std::filesystem::path& path) {
    if (path.stem() == "detections") ReadDetections(path);
    if (path.stem() == "objects") ReadTrueObjects(path);
    if (path.stem() == "changes") ReadTrueChanges(path);
  }

  TestFolder folder_;
};

TEST_F(BrokenFile, IsNamedWithTheLineWhereJsonEnds) {
  EXPECT_THAT(Problem("detections.json", "\"width_px\": 64", "\"width_px\" 64"),
              HasSubstr("detections.json:5: not JSON: "));
  EXPECT_THAT(Problem("detections.json", "64", "NaN"), HasSubstr("detections.json:5: not JSON"));
  EXPECT_THAT(Problem("detections.json", "64", "1e999"), HasSubstr("not usable JSON"));
}

TEST_F(BrokenFile, OfAnotherFormatOrANewerVersionSaysSo) {
  EXPECT_THAT(Problem("changes.json", "\"changes\"", "\"objects\""),
              HasSubstr("file of 'objects', expected 'changes'"));
  EXPECT_THAT(Problem("objects.json", "\"version\": 1", "\"version\": 2"),
              HasSubstr("version 2 is newer than this program, which reads up to 1"));
  EXPECT_THAT(Problem("objects.json", "\"version\": 1", "\"version\": \"1\""),
              HasSubstr("$.version: expected a number"));
}

TEST_F(BrokenFile, IsNamedWithThePlaceOfAWrongValue) {
  const auto detections = [&](std::string_view what, std::string_view by) {
    return Problem("detections.json", what, by);
  };
  EXPECT_THAT(detections("\"score\": 0.25", "\"score\": null"),
              HasSubstr("$.frames[0].detections[1].score: expected a number"));
  EXPECT_THAT(detections("0.25", "1.25"), HasSubstr("1.25 is not in 0 to 1"));
  EXPECT_THAT(detections("[1, 2, 30, 40]", "[1, 2, 30]"),
              HasSubstr("$.frames[0].detections[0].box_px: expected 4 elements, not 3"));
  EXPECT_THAT(detections("[1, 2, 30, 40]", "[30, 2, 1, 40]"), HasSubstr("max above min"));
  EXPECT_THAT(detections("700", "700.5"), HasSubstr("700.5 is not a whole number"));
  EXPECT_THAT(detections("1.033333", "1.0"), HasSubstr("$.frames[1].stamp: does not come after"));
  EXPECT_THAT(detections("\"1.033333\"", "1.033333"),
              HasSubstr("$.frames[1].stamp: expected a text"));
  EXPECT_THAT(detections("1.033333", "soon"), HasSubstr("expected seconds"));
  EXPECT_THAT(detections("\"visible_px\"", "\"visible\""), HasSubstr("'visible_px' is missing"));
  EXPECT_THAT(detections("\"visible_px\"", "\"mask\": 1, \"visible_px\""),
              HasSubstr("$.frames[0].detections[0]: unknown key 'mask'"));
  EXPECT_THAT(detections("{\"stamp\": \"1.033333\", \"detections\": []}", "[]"),
              HasSubstr("$.frames[1]: expected an object"));
}

TEST_F(BrokenFile, WithObjectsThatCannotBeIsRefused) {
  const auto objects = [&](std::string_view what, std::string_view by) {
    return Problem("objects.json", what, by);
  };
  EXPECT_THAT(objects("\"is_deformable\": false", "\"is_deformable\": 0"),
              HasSubstr("$.objects[0].is_deformable: expected true or false"));
  EXPECT_THAT(objects("\"instance\": 7", "\"instance\": 2"),
              HasSubstr("$.objects[1].instance: does not come after"));
  EXPECT_THAT(objects("[0.5, 0.6, 0.9]", "[0.5, -0.6, 0.9]"), HasSubstr("negative"));
  EXPECT_THAT(objects("\"to_s\": 2.5", "\"to_s\": -1"), HasSubstr("to_s lies before from_s"));
  EXPECT_THAT(objects("\"from_s\": 2.5", "\"from_s\": 2"),
              HasSubstr("$.objects[0].intervals[1]: begins before"));
  EXPECT_THAT(objects("-0.5", "5"), HasSubstr("$.objects[0].intervals[0].poses[0]: the last four"));
  EXPECT_THAT(objects("[2.6,", "[2.5,"), HasSubstr("poses[1]: its time does not come after"));
  EXPECT_THAT(objects("\"is_moving\": true", "\"is_moving\": false"), HasSubstr("has one pose"));
}

TEST_F(BrokenFile, WithChangesThatContradictTheirKindIsRefused) {
  const auto changes = [&](std::string_view what, std::string_view by) {
    return Problem("changes.json", what, by);
  };
  EXPECT_THAT(changes("\"moved\"", "\"stolen\""), HasSubstr("$.changes[0].kind: expected"));
  EXPECT_THAT(changes("\"moved\"", "\"added\""), HasSubstr("$.changes[0]: 'from' must be null"));
  EXPECT_THAT(changes("\"moved\"", "\"removed\""), HasSubstr("'to' must be null"));
  EXPECT_THAT(changes("\"moved\"", "\"replaced\""), HasSubstr("'new_instance'"));
  EXPECT_THAT(changes("\"time_s\": 9", "\"time_s\": 2"),
              HasSubstr("$.changes[3].time_s: lies before"));
}

TEST(ReadDetections, NamesAMissingFile) {
  EXPECT_THAT(MessageOf([] { ReadDetections("/nowhere/detections.json"); }),
              HasSubstr("/nowhere/detections.json"));
}

}  // namespace
}  // namespace cslam
