// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/trajectory_file.h"

#include "cslam/io/text_lines.h"
#include "cslam/util/atomic_file.h"
#include "cslam/util/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <system_error>
#include <vector>

namespace cslam {
namespace {

constexpr std::size_t kNumFields = 8;
// Files with two decimals exist; a wrong column order misses by far more.
constexpr double kQuaternionNormTolerance = 0.01;

std::optional<double> ParseFinite(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (!std::isfinite(value)) return std::nullopt;
  return value;
}

// where: "file:line" for the error message.
StampedPose ParsePose(const std::vector<std::string>& fields, const std::string& where) {
  if (fields.size() != kNumFields) {
    throw Error("{}: expected 8 numbers 'timestamp tx ty tz qx qy qz qw', found {} field{}{}",
                where, fields.size(), fields.size() == 1 ? "" : "s",
                fields[0].find(',') != std::string::npos ? " (separate them by blanks)" : "");
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

}  // namespace

Trajectory ParseTrajectory(std::string_view text, std::string_view name) {
  Trajectory trajectory;
  int last_line_number = 0;
  for (const TextLine& line : SplitTextLines(text)) {
    const std::string where = fmt::format("{}:{}", name, line.number);
    const StampedPose pose = ParsePose(line.fields, where);
    if (!trajectory.empty() && pose.stamp <= trajectory.back().stamp) {
      throw Error("{}: timestamp {} {} line {}; sort the file and remove duplicates", where,
                  Excerpt(line.fields[0]),
                  pose.stamp == trajectory.back().stamp ? "repeats" : "comes before that of",
                  last_line_number);
    }
    last_line_number = line.number;
    trajectory.push_back(pose);
  }
  return trajectory;
}

Trajectory ReadTrajectory(const std::filesystem::path& path) {
  return ParseTrajectory(ReadBytes(path, "trajectory"), path.string());
}

std::string FormatTrajectory(const Trajectory& trajectory, std::string_view comment) {
  std::string text;
  while (!comment.empty()) {
    const std::size_t end = std::min(comment.find('\n'), comment.size());
    fmt::format_to(std::back_inserter(text), "# {}\n", comment.substr(0, end));
    comment.remove_prefix(std::min(end + 1, comment.size()));
  }
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
