// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/trajectory_file.h"

#include "cslam/util/atomic_file.h"
#include "cslam/util/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <system_error>
#include <vector>

namespace cslam {
namespace {

constexpr std::size_t kNumFields = 8;
// Files with two decimals exist; a wrong column order misses by far more.
constexpr double kQuaternionNormTolerance = 0.01;
constexpr std::string_view kBlanks = " \t\r\v\f";

// Takes the first line, without its line feed, off the text.
std::string_view TakeLine(std::string_view& text) {
  const std::size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

std::vector<std::string_view> SplitAtBlanks(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t begin = line.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return fields;
    line.remove_prefix(begin);
    const std::size_t length = std::min(line.find_first_of(kBlanks), line.size());
    fields.push_back(line.substr(0, length));
    line.remove_prefix(length);
  }
}

std::optional<double> ParseFinite(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (!std::isfinite(value)) return std::nullopt;
  return value;
}

// A field as an error message may show it: short and printable.
std::string Excerpt(std::string_view field) {
  constexpr std::size_t kLongest = 40;
  std::string excerpt(field.substr(0, kLongest));
  for (char& c : excerpt) {
    if (c < ' ' || c > '~') c = '?';
  }
  return field.size() > kLongest ? excerpt + "..." : excerpt;
}

// where: "file:line" for the error message.
StampedPose ParsePose(const std::vector<std::string_view>& fields, const std::string& where) {
  if (fields.size() != kNumFields) {
    throw Error("{}: expected 8 numbers 'timestamp tx ty tz qx qy qz qw', found {} field{}{}",
                where, fields.size(), fields.size() == 1 ? "" : "s",
                fields[0].find(',') != std::string_view::npos ? " (separate them by blanks)" : "");
  }
  const std::optional<Stamp> stamp = ParseStamp(fields[0]);
  if (!stamp) throw Error("{}: '{}' is not a timestamp in seconds", where, Excerpt(fields[0]));
  std::array<double, kNumFields> value{};
  for (std::size_t i = 1; i < kNumFields; ++i) {
    const std::optional<double> number = ParseFinite(fields[i]);
    if (!number) throw Error("{}: '{}' is not a finite number", where, Excerpt(fields[i]));
    value[i] = *number;
  }
  const Eigen::Quaterniond rotation(value[7], value[4], value[5], value[6]);
  if (!(std::abs(rotation.norm() - 1.0) <= kQuaternionNormTolerance)) {
    throw Error("{}: quaternion qx qy qz qw has length {:.3g} instead of 1", where,
                rotation.norm());
  }
  return {*stamp, Se3(rotation, Eigen::Vector3d(value[1], value[2], value[3]))};
}

std::string ReadText(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw Error("cannot read trajectory '{}': it is a folder", path.string());
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw Error("cannot read trajectory '{}': {}", path.string(),
                std::generic_category().message(errno == 0 ? EIO : errno));
  }
  std::ostringstream text;
  text << file.rdbuf();
  if (file.bad()) throw Error("cannot read trajectory '{}': input error", path.string());
  return std::move(text).str();
}

void AppendComment(std::string& text, std::string_view comment) {
  while (!comment.empty())
    fmt::format_to(std::back_inserter(text), "# {}\n", TakeLine(comment));
}

}  // namespace

Trajectory ParseTrajectory(std::string_view text, std::string_view name) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  Trajectory trajectory;
  int line_number = 0;
  int last_line_number = 0;
  while (!text.empty()) {
    const std::vector<std::string_view> fields = SplitAtBlanks(TakeLine(text));
    ++line_number;
    if (fields.empty() || fields[0].starts_with('#')) continue;
    const std::string where = fmt::format("{}:{}", name, line_number);
    const StampedPose pose = ParsePose(fields, where);
    if (!trajectory.empty() && pose.stamp <= trajectory.back().stamp) {
      throw Error("{}: timestamp {} {} line {}; sort the file and remove duplicates", where,
                  Excerpt(fields[0]),
                  pose.stamp == trajectory.back().stamp ? "repeats" : "comes before that of",
                  last_line_number);
    }
    last_line_number = line_number;
    trajectory.push_back(pose);
  }
  return trajectory;
}

Trajectory ReadTrajectory(const std::filesystem::path& path) {
  return ParseTrajectory(ReadText(path), path.string());
}

std::string FormatTrajectory(const Trajectory& trajectory, std::string_view comment) {
  std::string text;
  AppendComment(text, comment);
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const auto& [stamp, T_world_camera] = trajectory[i];
    CSLAM_CHECK(T_world_camera.IsFinite(), "pose {}", i);
    CSLAM_CHECK(i == 0 || trajectory[i - 1].stamp < stamp, "pose {}", i);
    const Eigen::Vector3d& t = T_world_camera.translation;
    const Eigen::Quaterniond& q = T_world_camera.rotation;
    const double sign = q.w() < 0.0 ? -1.0 : 1.0;  // one spelling for each rotation
    fmt::format_to(std::back_inserter(text),
                   "{} {:.7f} {:.7f} {:.7f} {:.9f} {:.9f} {:.9f} {:.9f}\n", FormatStamp(stamp),
                   t.x(), t.y(), t.z(), sign * q.x(), sign * q.y(), sign * q.z(), sign * q.w());
  }
  return text;
}

void WriteTrajectory(const std::filesystem::path& path, const Trajectory& trajectory,
                     std::string_view comment) {
  WriteFileAtomically(path, FormatTrajectory(trajectory, comment));
}

}  // namespace cslam
