// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/report_files.h"

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

ReportedObjects SomeObjects() {
  ReportedObject chair{.id = 3, .map = 1, .class_id = 56, .state = "absent", .belief = 0.125};
  chair.centroid = {1.0, -2.0, 1.0 / 3.0};
  chair.box_center = {1.1, -2.1, 0.4};
  chair.box_size_m = {0.5, 0.6, 0.9};
  chair.box_rotation = Eigen::Quaterniond(-0.5, 0.5, -0.5, 0.5);
  chair.extent_min = {0.8, -2.4, 0.0};
  chair.extent_max = {1.4, -1.8, 0.9};
  chair.num_points = 120;
  chair.num_active_points = 100;
  chair.first_seen = Stamp{1'000'000'001};
  chair.last_seen = Stamp{1'305'031'453'359'684'123};
  chair.absent_since = Stamp{5'000'000'000};
  chair.history = {{Stamp{1'000'000'001}, 0.5, "seen"}, {Stamp{5'000'000'000}, 0.125, "absent"}};
  const ReportedObject cup{.id = 4, .class_id = 41, .state = "candidate"};
  return {.sequence = "a \"b\"", .objects = {chair, cup}};
}

ReportedChanges SomeChanges() {
  ReportedChange moved{.kind = ChangeKind::kMoved, .object = 3, .class_id = 56};
  moved.from = Eigen::Vector3d(1.0, 2.0, 3.0);
  moved.to = Eigen::Vector3d(1.5, 2.0, 3.0);
  moved.last_seen_there = Stamp{7'000'000'001};
  moved.first_seen_absent = Stamp{8'000'000'000};
  moved.reported = Stamp{9'000'000'000};
  moved.confidence = 0.75;
  moved.num_absent_views = 5;
  moved.num_seen_views = 6;
  ReportedChange added{.kind = ChangeKind::kAdded, .object = 5, .class_id = 62};
  added.to = Eigen::Vector3d(0.0, 0.0, 1.0);
  added.is_between_sessions = true;
  ReportedChange replaced{.kind = ChangeKind::kReplaced, .object = 6, .new_object = 7};
  replaced.class_id = 56;
  replaced.new_class_id = 25;
  replaced.from = replaced.to = Eigen::Vector3d(4.0, 0.0, 0.0);
  ReportedChange removed{.kind = ChangeKind::kRemoved, .object = 8, .class_id = 41};
  removed.from = Eigen::Vector3d(4.0, 1.0, 0.0);
  return {.sequence = "demo", .changes = {moved, added, replaced, removed}};
}

TEST(ReportedObjects, ReadBackAsWritten) {
  const TestFolder folder;
  WriteReportedObjects(folder / "objects.json", SomeObjects());
  const ReportedObjects read = ReadReportedObjects(folder / "objects.json");
  const ReportedObject chair = SomeObjects().objects[0];
  EXPECT_EQ(read.sequence, "a \"b\"");
  ASSERT_EQ(read.objects.size(), 2U);
  const ReportedObject& a = read.objects[0];
  EXPECT_EQ(a.id, 3);
  EXPECT_EQ(a.map, 1);
  EXPECT_EQ(a.class_id, 56);
  EXPECT_EQ(a.state, "absent");
  EXPECT_EQ(a.belief, 0.125);
  EXPECT_TRUE(a.centroid.isApprox(chair.centroid, 1e-8));
  EXPECT_EQ(a.box_center, chair.box_center);
  EXPECT_EQ(a.box_size_m, chair.box_size_m);
  EXPECT_LT(a.box_rotation.angularDistance(chair.box_rotation), 1e-7);
  EXPECT_EQ(a.extent_min, chair.extent_min);
  EXPECT_EQ(a.extent_max, chair.extent_max);
  EXPECT_EQ(a.num_points, 120);
  EXPECT_EQ(a.num_active_points, 100);
  EXPECT_EQ(a.first_seen, chair.first_seen);
  EXPECT_EQ(a.last_seen, chair.last_seen);
  EXPECT_EQ(a.absent_since, chair.absent_since);
  ASSERT_EQ(a.history.size(), 2U);
  EXPECT_EQ(a.history[1].stamp, chair.history[1].stamp);
  EXPECT_EQ(a.history[1].belief, 0.125);
  EXPECT_EQ(a.history[1].cause, "absent");
  EXPECT_FALSE(read.objects[1].absent_since);
  EXPECT_TRUE(read.objects[1].history.empty());
}

TEST(ReportedChanges, ReadBackAsWritten) {
  const TestFolder folder;
  const ReportedChanges changes = SomeChanges();
  WriteReportedChanges(folder / "changes.json", changes);
  const ReportedChanges read = ReadReportedChanges(folder / "changes.json");
  EXPECT_EQ(read.sequence, "demo");
  ASSERT_EQ(read.changes.size(), changes.changes.size());
  for (std::size_t i = 0; i < changes.changes.size(); ++i)
    EXPECT_TRUE(read.changes[i] == changes.changes[i]) << "change " << i << " in\n"
                                                       << TestFolder::Read(folder / "changes.json");
}

TEST(ReportFiles, WithNothingToReportReadBackEmpty) {
  const TestFolder folder;
  WriteReportedObjects(folder / "objects.json", {});
  WriteReportedChanges(folder / "changes.json", {});
  EXPECT_TRUE(ReadReportedObjects(folder / "objects.json").objects.empty());
  EXPECT_TRUE(ReadReportedChanges(folder / "changes.json").changes.empty());
}

TEST(WriteReportedObjects, RefusesWhatJsonCannotSay) {
  const TestFolder folder;
  ReportedObjects objects = SomeObjects();
  objects.objects[0].centroid.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(WriteReportedObjects(folder / "objects.json", objects), InternalError);
  EXPECT_FALSE(std::filesystem::exists(folder / "objects.json"));
}

// What the readers say to a good file with a text in it replaced.
class BrokenReport : public testing::Test {
 protected:
  std::string Objects(std::string_view what, std::string_view by) {
    WriteReportedObjects(folder_ / "objects.json", SomeObjects());
    return test::ProblemOf(folder_ / "objects.json", what, by, ReadReportedObjects);
  }
  std::string Changes(std::string_view what, std::string_view by) {
    WriteReportedChanges(folder_ / "changes.json", SomeChanges());
    return test::ProblemOf(folder_ / "changes.json", what, by, ReadReportedChanges);
  }

 private:
  TestFolder folder_;
};

TEST_F(BrokenReport, OfAnotherFormatOrANewerVersionSaysSo) {
  EXPECT_THAT(Objects("\"map_objects\"", "\"objects\""),
              HasSubstr("file of 'objects', expected 'map_objects'"));
  EXPECT_THAT(Changes("\"version\": 1", "\"version\": 2"),
              HasSubstr("version 2 is newer than this program"));
}

TEST_F(BrokenReport, IsNamedWithFileAndPlaceOfAWrongValue) {
  EXPECT_THAT(Objects("\"belief\": 0.125", "\"belief\": 1.5"),
              HasSubstr("objects.json: $.objects[0].belief: 1.5 is not in 0 to 1"));
  EXPECT_THAT(Objects("\"absent\"", "\"gone\""), HasSubstr("$.objects[0].state: expected"));
  EXPECT_THAT(Objects("\"id\": 4", "\"id\": 3"), HasSubstr("$.objects[1].id: an object before"));
  EXPECT_THAT(Objects("\"num_active_points\": 100", "\"num_active_points\": 121"),
              HasSubstr("$.objects[0].num_active_points"));
  EXPECT_THAT(Objects("[0.5, 0.6, 0.9]", "[0.5, -0.6, 0.9]"), HasSubstr("negative"));
  EXPECT_THAT(Objects("\"rotation_xyzw\": [", "\"rotation_xyzw\": [2, 0, 0, 0], \"x\": ["),
              HasSubstr("unknown key 'x'"));
  EXPECT_THAT(Objects("[0.8, -2.4, 0]", "[0.8, -1.4, 0]"), HasSubstr("max_m lies below min_m"));
  EXPECT_THAT(Objects("\"1.000000001\"", "1.0"), HasSubstr("$.objects[0].first_seen"));
  EXPECT_THAT(Objects("\"cause\": \"seen\"", "\"cause\": 3"),
              HasSubstr("$.objects[0].history[0].cause: expected a text"));
}

TEST_F(BrokenReport, WithChangesThatContradictTheirKindIsRefused) {
  EXPECT_THAT(Changes("\"moved\"", "\"added\""),
              HasSubstr("changes.json: $.changes[0]: 'from_m' must be null"));
  EXPECT_THAT(Changes("\"moved\"", "\"removed\""), HasSubstr("'to_m' must be null"));
  EXPECT_THAT(Changes("\"moved\"", "\"stolen\""), HasSubstr("$.changes[0].kind: expected"));
}

TEST(ReadReportedObjects, NamesAMissingFile) {
  EXPECT_THAT(MessageOf([] { ReadReportedObjects("/nowhere/objects.json"); }),
              HasSubstr("/nowhere/objects.json"));
}

}  // namespace
}  // namespace cslam
