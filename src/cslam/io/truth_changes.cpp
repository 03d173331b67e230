// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/truth_files.h"
#include "cslam/io/truth_json.h"
#include "cslam/util/check.h"

#include <fmt/format.h>

#include <utility>

namespace cslam {
namespace {

constexpr char kFormat[] = "changes";

TrueChange ReadChange(const JsonValue& value) {
  value.RequireKeys({"kind", "time_s", "instance", "class_id", "new_instance", "new_class_id",
                     "from", "to", "is_carried_in_view"});
  TrueChange change;
  change.kind = ReadChangeKind(value, "from", "to");
  change.time_s = value.At("time_s").Number();
  change.instance = value.At("instance").IntegerIn(1, kMaxInstance);
  change.class_id = value.At("class_id").IntegerIn(-1, kMaxClass);
  change.new_instance = value.At("new_instance").IntegerIn(0, kMaxInstance);
  change.new_class_id = value.At("new_class_id").IntegerIn(-1, kMaxClass);
  const auto read_pose = [](const JsonValue& pose) { return ReadPose(pose); };
  change.from = ReadOptional(value.At("from"), read_pose);
  change.to = ReadOptional(value.At("to"), read_pose);
  change.is_carried_in_view = value.At("is_carried_in_view").Bool();
  if ((change.new_instance != 0) != (change.kind == ChangeKind::kReplaced))
    value.Fail("'new_instance' must be above 0 when something is replaced, and only then");
  return change;
}

std::string FormatOptionalPose(const std::optional<Se3>& pose) {
  return pose ? JsonPose(*pose) : "null";
}

std::string FormatChange(const TrueChange& change) {
  return fmt::format(
      "    {{\"time_s\": {}, \"kind\": \"{}\", \"instance\": {}, \"class_id\": {},\n"
      "      \"new_instance\": {}, \"new_class_id\": {}, \"is_carried_in_view\": {},\n"
      "      \"from\": {},\n      \"to\": {}}}",
      JsonNumber(change.time_s), NameOf(change.kind), change.instance, change.class_id,
      change.new_instance, change.new_class_id, change.is_carried_in_view,
      FormatOptionalPose(change.from), FormatOptionalPose(change.to));
}

}  // namespace

std::string_view NameOf(ChangeKind kind) {
  switch (kind) {
    case ChangeKind::kRemoved:
      return "removed";
    case ChangeKind::kAdded:
      return "added";
    case ChangeKind::kMoved:
      return "moved";
    case ChangeKind::kReplaced:
      return "replaced";
  }
  throw InternalError("kind", "no such kind of change", std::source_location::current());
}

TrueChanges ReadTrueChanges(const std::filesystem::path& file) {
  const JsonFile json(file);
  const JsonValue root = json.root();
  RequireFormat(root, kFormat);
  root.RequireKeys({"format", "version", "sequence", "changes"});
  TrueChanges changes;
  changes.sequence = root.At("sequence").Text();
  for (const JsonValue& value : root.At("changes").Items()) {
    TrueChange change = ReadChange(value);
    if (!changes.changes.empty() && change.time_s < changes.changes.back().time_s)
      value.At("time_s").Fail("lies before that of the change before");
    changes.changes.push_back(std::move(change));
  }
  return changes;
}

void WriteTrueChanges(const std::filesystem::path& file, const TrueChanges& changes) {
  const ListFileHead head{
      .format = kFormat, .sequence = changes.sequence, .fields = "", .list = "changes"};
  WriteListFile(file, head, changes.changes, FormatChange);
}

}  // namespace cslam
