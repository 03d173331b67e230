// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/atlas_io/sqlite_file.h"
#include "cslam/geometry/se3.h"
#include "cslam/util/id.h"
#include "cslam/util/stamp.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>

// Private to the writers and readers of map files: values of several columns, and checked ones. An
// invalid id, or a value that is not there, is stored as NULL. Readers throw Error.
namespace cslam {

void WriteIdValue(TableWriter& row, bool is_valid, std::uint32_t value);
template <typename AnyId>
void WriteId(TableWriter& row, AnyId id) {
  WriteIdValue(row, id.valid(), id.value());
}
void WriteNulls(TableWriter& row, int count);
void WriteVector(TableWriter& row, const Eigen::Vector3d& v);
void WriteRotation(TableWriter& row, const Eigen::Quaterniond& rotation);  // x y z w
void WritePose(TableWriter& row, const Se3& pose);                         // translation first
void WriteStamp(TableWriter& row, std::optional<Stamp> stamp);

std::optional<std::uint32_t> ReadIdValue(TableReader& row);
template <typename AnyId>
AnyId ReadId(TableReader& row) {
  const auto value = ReadIdValue(row);
  return value ? AnyId(*value) : AnyId();
}
std::uint32_t ReadRowId(TableReader& row);  // ids count from 0
int ReadInt(TableReader& row, int min, int max);
double ReadFinite(TableReader& row);
void SkipNulls(TableReader& row, int count);
Eigen::Vector3d ReadVector(TableReader& row);
Eigen::Quaterniond ReadRotation(TableReader& row);
Se3 ReadPose(TableReader& row);
std::optional<Stamp> ReadStamp(TableReader& row);

}  // namespace cslam
