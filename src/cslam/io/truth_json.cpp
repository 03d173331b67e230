// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/truth_json.h"

#include "cslam/util/check.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace cslam {
namespace {

constexpr double kMaxQuaternionError = 0.01;  // of its length, as for trajectories
constexpr std::array kChangeKinds{ChangeKind::kRemoved, ChangeKind::kAdded, ChangeKind::kMoved,
                                  ChangeKind::kReplaced};

ChangeKind ReadKind(const JsonValue& value) {
  const std::string name = value.Text();
  for (const ChangeKind kind : kChangeKinds) {
    if (name == NameOf(kind)) return kind;
  }
  value.Fail("expected \"removed\", \"added\", \"moved\" or \"replaced\"");
}

}  // namespace

void RequireFormat(const JsonValue& root, std::string_view format) {
  const std::string found = root.At("format").Text();
  if (found != format)
    root.Fail(fmt::format("this is a file of '{}', expected '{}'", found, format));
  const int version = root.At("version").IntegerIn(1, std::numeric_limits<int>::max());
  if (version > kTruthFileVersion) {
    root.Fail(fmt::format("version {} is newer than this program, which reads up to {}", version,
                          kTruthFileVersion));
  }
}

std::string TruthHeader(std::string_view format, std::string_view sequence) {
  return fmt::format("{{\n  \"format\": \"{}\",\n  \"version\": {},\n  \"sequence\": {},\n", format,
                     kTruthFileVersion, JsonQuoted(sequence));
}

std::string ListStart(const ListFileHead& head) {
  return fmt::format("{}{}  \"{}\": [", TruthHeader(head.format, head.sequence), head.fields,
                     head.list);
}

std::string JsonNumber(double value) {
  constexpr double kPerUnit = 1e9;
  return JsonExact(std::round(value * kPerUnit) / kPerUnit);
}

std::string JsonExact(double value) {
  CSLAM_CHECK(std::isfinite(value), "JSON has no {}", value);
  return fmt::format("{}", value == 0.0 ? 0.0 : value);  // no "-0"
}

std::string JsonArray(const Eigen::VectorXd& values) {
  std::string text = "[";
  for (const double value : values)
    text += fmt::format("{}{}", text.size() > 1 ? ", " : "", JsonNumber(value));
  return text + "]";
}

std::string JsonPose(const Se3& T) {
  Eigen::Matrix<double, 7, 1> values;
  const double sign = T.rotation.w() < 0.0 ? -1.0 : 1.0;
  values << T.translation, sign * T.rotation.coeffs();  // x, y, z, w
  return JsonArray(values);
}

Se3 ReadPose(const JsonValue& value, const std::vector<JsonValue>& items, std::size_t first) {
  const auto number = [&](std::size_t i) { return items.at(first + i).Number(); };
  const Eigen::Quaterniond rotation(number(6), number(3), number(4), number(5));
  if (std::abs(rotation.norm() - 1.0) > kMaxQuaternionError)
    value.Fail("the last four numbers are no unit quaternion");
  return {rotation, {number(0), number(1), number(2)}};
}

Se3 ReadPose(const JsonValue& value) {
  return ReadPose(value, value.Items(7), 0);
}

Eigen::Vector3d ReadVector3(const JsonValue& value) {
  const std::vector<JsonValue> items = value.Items(3);
  return {items[0].Number(), items[1].Number(), items[2].Number()};
}

Eigen::Vector3d ReadSize(const JsonValue& value) {
  const Eigen::Vector3d size_m = ReadVector3(value);
  if (size_m.minCoeff() < 0.0) value.Fail("a size is negative");
  return size_m;
}

ChangeKind ReadChangeKind(const JsonValue& change, std::string_view from_key,
                          std::string_view to_key) {
  const ChangeKind kind = ReadKind(change.At("kind"));
  const auto require_null = [&](std::string_view key, ChangeKind when) {
    if (change.At(key).IsNull() == (kind == when)) return;
    change.Fail(
        fmt::format("'{}' must be null when something is {}, and only then", key, NameOf(when)));
  };
  require_null(from_key, ChangeKind::kAdded);
  require_null(to_key, ChangeKind::kRemoved);
  return kind;
}

std::string JsonStamp(Stamp stamp) {
  constexpr int kMicroseconds = 6;
  constexpr int kNanoseconds = 9;
  return fmt::format("\"{}\"",
                     FormatStamp(stamp, stamp.ns % 1000 == 0 ? kMicroseconds : kNanoseconds));
}

Stamp ReadStamp(const JsonValue& value) {
  const std::optional<Stamp> stamp = ParseStamp(value.Text());
  if (!stamp) value.Fail("expected seconds in quotes, like \"1.033333\"");
  return *stamp;
}

}  // namespace cslam
