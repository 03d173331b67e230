// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/atlas_io/row_values.h"

#include "cslam/util/check.h"

#include <cmath>
#include <limits>

namespace cslam {

void WriteIdValue(TableWriter& row, bool is_valid, std::uint32_t value) {
  if (is_valid) {
    row.Int(value);
  } else {
    row.Null();
  }
}

void WriteNulls(TableWriter& row, int count) {
  for (int i = 0; i < count; ++i)
    row.Null();
}

void WriteVector(TableWriter& row, const Eigen::Vector3d& v) {
  for (const double value : v)
    row.Double(value);
}

void WriteRotation(TableWriter& row, const Eigen::Quaterniond& rotation) {
  for (const double value : rotation.coeffs())
    row.Double(value);
}

void WritePose(TableWriter& row, const Se3& pose) {
  WriteVector(row, pose.translation);
  WriteRotation(row, pose.rotation);
}

void WriteStamp(TableWriter& row, std::optional<Stamp> stamp) {
  if (stamp) {
    row.Int(stamp->ns);
  } else {
    row.Null();
  }
}

std::optional<std::uint32_t> ReadIdValue(TableReader& row) {
  if (row.IsNull()) {
    row.SkipNull();
    return std::nullopt;
  }
  const std::int64_t value = row.Int();
  if (value < 0 || value >= std::numeric_limits<std::uint32_t>::max()) {
    throw Error("an id is {}", value);
  }
  return static_cast<std::uint32_t>(value);
}

// This also ends a walk in circles through a damaged file.
std::uint32_t ReadRowId(TableReader& row) {
  const std::int64_t id = row.Int();
  if (id != row.num_rows() - 1 || id >= std::numeric_limits<std::uint32_t>::max()) {
    throw Error("row {} has id {}", row.num_rows() - 1, id);
  }
  return static_cast<std::uint32_t>(id);
}

int ReadInt(TableReader& row, int min, int max) {
  const std::int64_t value = row.Int();
  if (value < min || value > max) throw Error("{} is not in [{}, {}]", value, min, max);
  return static_cast<int>(value);
}

double ReadFinite(TableReader& row) {
  const double value = row.Double();
  if (!std::isfinite(value)) throw Error("a number is not finite");
  return value;
}

void SkipNulls(TableReader& row, int count) {
  for (int i = 0; i < count; ++i)
    row.SkipNull();
}

Eigen::Vector3d ReadVector(TableReader& row) {
  Eigen::Vector3d v;
  for (double& value : v)
    value = row.Double();
  return v;
}

Eigen::Quaterniond ReadRotation(TableReader& row) {
  constexpr double kMaxLengthError = 1e-6;  // of a unit quaternion after many products
  Eigen::Quaterniond rotation;
  for (double& value : rotation.coeffs())
    value = row.Double();
  if (!(std::abs(rotation.norm() - 1.0) < kMaxLengthError)) throw Error("a rotation is none");
  return rotation;
}

Se3 ReadPose(TableReader& row) {
  Se3 pose;
  pose.translation = ReadVector(row);
  pose.rotation = ReadRotation(row);
  if (!pose.IsFinite()) throw Error("a pose is none");
  return pose;
}

std::optional<Stamp> ReadStamp(TableReader& row) {
  if (!row.IsNull()) return Stamp{row.Int()};
  row.SkipNull();
  return std::nullopt;
}

}  // namespace cslam
