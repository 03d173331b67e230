// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"
#include "cslam/io/json_reader.h"
#include "cslam/io/truth_files.h"
#include "cslam/util/atomic_file.h"
#include "cslam/util/stamp.h"

#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

// What the truth files and the reports of a run (report_files.h) have in common.

namespace cslam {

constexpr int kMaxInstance = 65535;  // of a 16-bit image
constexpr int kMaxClass = 1'000'000;

// The file is of that format and of a version this program knows; otherwise Error.
void RequireFormat(const JsonValue& root, std::string_view format);

// "{\n  "format": ..., "version": ..., "sequence": ...": the start of every file, not closed.
std::string TruthHeader(std::string_view format, std::string_view sequence);

// What comes before the items of a file that holds one list.
struct ListFileHead {
  std::string_view format;
  std::string_view sequence;
  std::string_view fields;  // of its own before the list, as JSON lines that end in ",\n"; or none
  std::string_view list;    // the key of the list
};
std::string ListStart(const ListFileHead& head);

// Writes such a file, item by item; format(item) gives the item's JSON, indented by four blanks.
template <typename Items, typename Format>
void WriteListFile(const std::filesystem::path& file, const ListFileHead& head, const Items& items,
                   Format format) {
  AtomicFile out(file);
  out.Write(ListStart(head));
  bool is_first = true;
  for (const auto& item : items) {
    out.Print("{}\n{}", is_first ? "" : ",", format(item));
    is_first = false;
  }
  out.Write("\n  ]\n}\n");
  out.Commit();
}

// Rounded to 9 decimals: nanometres, nanoseconds. The value must be finite.
std::string JsonNumber(double value);
// With all the digits it takes to read the same value again.
std::string JsonExact(double value);
std::string JsonArray(const Eigen::VectorXd& values);

// [tx, ty, tz, qx, qy, qz, qw], qw >= 0.
std::string JsonPose(const Se3& T);
Se3 ReadPose(const JsonValue& value);
// The same of 7 elements of a longer array.
Se3 ReadPose(const JsonValue& value, const std::vector<JsonValue>& items, std::size_t first);

Eigen::Vector3d ReadVector3(const JsonValue& value);
Eigen::Vector3d ReadSize(const JsonValue& value);  // none of it negative

// The kind of a change. Where the thing was (from_key) must be null if it was added, and where it
// is (to_key) if it was removed, and only then.
ChangeKind ReadChangeKind(const JsonValue& change, std::string_view from_key,
                          std::string_view to_key);

// Nothing for null; otherwise what read(value) makes of it.
template <typename Read>
auto ReadOptional(const JsonValue& value, Read read) -> std::optional<decltype(read(value))> {
  if (value.IsNull()) return std::nullopt;
  return read(value);
}

// "1.033333", as in file names and lists.
std::string JsonStamp(Stamp stamp);
Stamp ReadStamp(const JsonValue& value);

}  // namespace cslam
