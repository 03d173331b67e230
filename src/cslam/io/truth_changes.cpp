// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/truth_files.h"
#include "cslam/io/truth_json.h"
#include "cslam/util/atomic_file.h"
#include "cslam/util/check.h"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace cslam {
namespace {

constexpr char kFormat[] = "changes";
constexpr std::array kKinds{ChangeKind::kRemoved, ChangeKind::kAdded, ChangeKind::kMoved,
                            ChangeKind::kReplaced};

ChangeKind ReadKind(const JsonValue& value) {
  const std::string name = value.Text();
  for (const ChangeKind kind : kKinds) {
    if (name == NameOf(kind)) return kind;
  }
  value.Fail("expected \"removed\", \"added\", \"moved\" or \"replaced\"");
}

std::optional<Se3> ReadOptionalPose(const JsonValue& value) {
  if (value.IsNull()) return std::nullopt;
  return ReadPose(value);
}

// Which of the fields a kind has: the thing before, where it was and where what is there now is.
void CheckFields(const JsonValue& value, const TrueChange& change) {
  const bool is_replaced = change.kind == ChangeKind::kReplaced;
  if (change.from.has_value() == (change.kind == ChangeKind::kAdded))
    value.Fail("'from' must be null when something is added, and only then");
  if (change.to.has_value() == (change.kind == ChangeKind::kRemoved))
    value.Fail("'to' must be null when something is removed, and only then");
  if ((change.new_instance != 0) != is_replaced)
    value.Fail("'new_instance' must be above 0 when something is replaced, and only then");
}

TrueChange ReadChange(const JsonValue& value) {
  value.RequireKeys({"kind", "time_s", "instance", "class_id", "new_instance", "new_class_id",
                     "from", "to", "is_carried_in_view"});
  TrueChange change;
  change.kind = ReadKind(value.At("kind"));
  change.time_s = value.At("time_s").Number();
  change.instance = value.At("instance").IntegerIn(1, kMaxInstance);
  change.class_id = value.At("class_id").IntegerIn(-1, kMaxClass);
  change.new_instance = value.At("new_instance").IntegerIn(0, kMaxInstance);
  change.new_class_id = value.At("new_class_id").IntegerIn(-1, kMaxClass);
  change.from = ReadOptionalPose(value.At("from"));
  change.to = ReadOptionalPose(value.At("to"));
  change.is_carried_in_view = value.At("is_carried_in_view").Bool();
  CheckFields(value, change);
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
  AtomicFile out(file);
  out.Write(TruthHeader(kFormat, changes.sequence));
  out.Write("  \"changes\": [");
  for (std::size_t i = 0; i < changes.changes.size(); ++i)
    out.Print("{}\n{}", i == 0 ? "" : ",", FormatChange(changes.changes[i]));
  out.Write("\n  ]\n}\n");
  out.Commit();
}

}  // namespace cslam
