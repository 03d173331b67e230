// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/report_files.h"

#include "cslam/io/truth_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

namespace cslam {
namespace {

constexpr char kObjectsFormat[] = "map_objects";
constexpr char kChangesFormat[] = "map_changes";
constexpr int kMaxInt = std::numeric_limits<int>::max();
constexpr double kMaxQuaternionError = 0.01;  // of its length, as for trajectories
constexpr std::array<std::string_view, 3> kStates{"candidate", "present", "absent"};

std::string StampText(Stamp stamp) {
  constexpr int kNanoseconds = 9;
  return fmt::format("\"{}\"", FormatStamp(stamp, kNanoseconds));
}

std::string OptionalStamp(const std::optional<Stamp>& stamp) {
  return stamp ? StampText(*stamp) : "null";
}

std::string OptionalPlace(const std::optional<Eigen::Vector3d>& place) {
  return place ? JsonArray(*place) : "null";
}

Eigen::Quaterniond ReadRotation(const JsonValue& value) {
  const std::vector<JsonValue> items = value.Items(4);
  const Eigen::Quaterniond q(items[3].Number(), items[0].Number(), items[1].Number(),
                             items[2].Number());
  if (std::abs(q.norm() - 1.0) > kMaxQuaternionError) value.Fail("is no unit quaternion");
  return q.normalized();
}

std::string ReadState(const JsonValue& value) {
  std::string state = value.Text();
  if (std::find(kStates.begin(), kStates.end(), state) == kStates.end())
    value.Fail("expected \"candidate\", \"present\" or \"absent\"");
  return state;
}

BeliefSample ReadBeliefSample(const JsonValue& value) {
  value.RequireKeys({"stamp", "belief", "cause"});
  return {.stamp = ReadStamp(value.At("stamp")),
          .belief = value.At("belief").NumberIn(0.0, 1.0),
          .cause = value.At("cause").Text()};
}

// An object of which only the boxes are known yet.
ReportedObject ReadBoxes(const JsonValue& box, const JsonValue& extent) {
  box.RequireKeys({"center_m", "size_m", "rotation_xyzw"});
  extent.RequireKeys({"min_m", "max_m"});
  ReportedObject object;
  object.box_center = ReadVector3(box.At("center_m"));
  object.box_size_m = ReadSize(box.At("size_m"));
  object.box_rotation = ReadRotation(box.At("rotation_xyzw"));
  object.extent_min = ReadVector3(extent.At("min_m"));
  object.extent_max = ReadVector3(extent.At("max_m"));
  if ((object.extent_max - object.extent_min).minCoeff() < 0.0)
    extent.Fail("max_m lies below min_m");
  return object;
}

ReportedObject ReadObject(const JsonValue& value) {
  value.RequireKeys({"id", "map", "class_id", "state", "belief", "centroid_m", "box", "extent",
                     "num_points", "num_active_points", "first_seen", "last_seen", "absent_since",
                     "history"});
  ReportedObject object = ReadBoxes(value.At("box"), value.At("extent"));
  object.id = value.At("id").IntegerIn(0, kMaxInt);
  object.map = value.At("map").IntegerIn(0, kMaxInt);
  object.class_id = value.At("class_id").IntegerIn(-1, kMaxClass);
  object.state = ReadState(value.At("state"));
  object.belief = value.At("belief").NumberIn(0.0, 1.0);
  object.centroid = ReadVector3(value.At("centroid_m"));
  object.num_points = value.At("num_points").IntegerIn(0, kMaxInt);
  object.num_active_points = value.At("num_active_points").IntegerIn(0, object.num_points);
  object.first_seen = ReadStamp(value.At("first_seen"));
  object.last_seen = ReadStamp(value.At("last_seen"));
  object.absent_since = ReadOptional(value.At("absent_since"), ReadStamp);
  for (const JsonValue& item : value.At("history").Items())
    object.history.push_back(ReadBeliefSample(item));
  return object;
}

ReportedChange ReadChange(const JsonValue& value) {
  value.RequireKeys({"kind", "object", "new_object", "class_id", "new_class_id", "from_m", "to_m",
                     "last_seen_there", "first_seen_absent", "reported", "confidence",
                     "num_absent_views", "num_seen_views", "is_between_sessions"});
  ReportedChange change;
  change.kind = ReadChangeKind(value, "from_m", "to_m");
  change.object = value.At("object").IntegerIn(-1, kMaxInt);
  change.new_object = value.At("new_object").IntegerIn(-1, kMaxInt);
  change.class_id = value.At("class_id").IntegerIn(-1, kMaxClass);
  change.new_class_id = value.At("new_class_id").IntegerIn(-1, kMaxClass);
  change.from = ReadOptional(value.At("from_m"), ReadVector3);
  change.to = ReadOptional(value.At("to_m"), ReadVector3);
  change.last_seen_there = ReadStamp(value.At("last_seen_there"));
  change.first_seen_absent = ReadOptional(value.At("first_seen_absent"), ReadStamp);
  change.reported = ReadStamp(value.At("reported"));
  change.confidence = value.At("confidence").NumberIn(0.0, 1.0);
  change.num_absent_views = value.At("num_absent_views").IntegerIn(0, kMaxInt);
  change.num_seen_views = value.At("num_seen_views").IntegerIn(0, kMaxInt);
  change.is_between_sessions = value.At("is_between_sessions").Bool();
  const bool has_successor =
      change.kind == ChangeKind::kReplaced || change.kind == ChangeKind::kMoved;
  if (!has_successor && change.new_object != -1)
    value.Fail("'new_object' must be -1 unless something is moved or replaced");
  return change;
}

std::string FormatHistory(const std::vector<BeliefSample>& history) {
  std::string text = "[";
  for (const BeliefSample& sample : history) {
    text += fmt::format("{}\n        {{\"stamp\": {}, \"belief\": {}, \"cause\": {}}}",
                        text.size() > 1 ? "," : "", StampText(sample.stamp),
                        JsonNumber(sample.belief), JsonQuoted(sample.cause));
  }
  return text + "]";
}

std::string FormatObject(const ReportedObject& object) {
  const Eigen::Quaterniond q = object.box_rotation.normalized();
  const Eigen::Vector4d rotation = (q.w() < 0.0 ? -1.0 : 1.0) * q.coeffs();  // x, y, z, w
  return fmt::format(
      "    {{\"id\": {}, \"map\": {}, \"class_id\": {}, \"state\": {}, \"belief\": {},\n"
      "      \"centroid_m\": {},\n"
      "      \"box\": {{\"center_m\": {}, \"size_m\": {},\n        \"rotation_xyzw\": {}}},\n"
      "      \"extent\": {{\"min_m\": {}, \"max_m\": {}}},\n"
      "      \"num_points\": {}, \"num_active_points\": {},\n"
      "      \"first_seen\": {}, \"last_seen\": {}, \"absent_since\": {},\n"
      "      \"history\": {}}}",
      object.id, object.map, object.class_id, JsonQuoted(object.state), JsonNumber(object.belief),
      JsonArray(object.centroid), JsonArray(object.box_center), JsonArray(object.box_size_m),
      JsonArray(rotation), JsonArray(object.extent_min), JsonArray(object.extent_max),
      object.num_points, object.num_active_points, StampText(object.first_seen),
      StampText(object.last_seen), OptionalStamp(object.absent_since),
      FormatHistory(object.history));
}

std::string FormatChange(const ReportedChange& change) {
  return fmt::format(
      "    {{\"kind\": \"{}\", \"object\": {}, \"new_object\": {}, \"class_id\": {},"
      " \"new_class_id\": {},\n"
      "      \"from_m\": {}, \"to_m\": {},\n"
      "      \"last_seen_there\": {}, \"first_seen_absent\": {}, \"reported\": {},\n"
      "      \"confidence\": {}, \"num_absent_views\": {}, \"num_seen_views\": {},"
      " \"is_between_sessions\": {}}}",
      NameOf(change.kind), change.object, change.new_object, change.class_id, change.new_class_id,
      OptionalPlace(change.from), OptionalPlace(change.to), StampText(change.last_seen_there),
      OptionalStamp(change.first_seen_absent), StampText(change.reported),
      JsonNumber(change.confidence), change.num_absent_views, change.num_seen_views,
      change.is_between_sessions);
}

}  // namespace

ReportedObjects ReadReportedObjects(const std::filesystem::path& file) {
  const JsonFile json(file);
  const JsonValue root = json.root();
  RequireFormat(root, kObjectsFormat);
  root.RequireKeys({"format", "version", "sequence", "objects"});
  ReportedObjects objects{.sequence = root.At("sequence").Text(), .objects = {}};
  std::set<int> ids;
  for (const JsonValue& item : root.At("objects").Items()) {
    objects.objects.push_back(ReadObject(item));
    if (!ids.insert(objects.objects.back().id).second)
      item.At("id").Fail("an object before has the same");
  }
  return objects;
}

ReportedChanges ReadReportedChanges(const std::filesystem::path& file) {
  const JsonFile json(file);
  const JsonValue root = json.root();
  RequireFormat(root, kChangesFormat);
  root.RequireKeys({"format", "version", "sequence", "changes"});
  ReportedChanges changes{.sequence = root.At("sequence").Text(), .changes = {}};
  for (const JsonValue& item : root.At("changes").Items())
    changes.changes.push_back(ReadChange(item));
  return changes;
}

void WriteReportedObjects(const std::filesystem::path& file, const ReportedObjects& objects) {
  const ListFileHead head{
      .format = kObjectsFormat, .sequence = objects.sequence, .fields = "", .list = "objects"};
  WriteListFile(file, head, objects.objects, FormatObject);
}

void WriteReportedChanges(const std::filesystem::path& file, const ReportedChanges& changes) {
  const ListFileHead head{
      .format = kChangesFormat, .sequence = changes.sequence, .fields = "", .list = "changes"};
  WriteListFile(file, head, changes.changes, FormatChange);
}

}  // namespace cslam
