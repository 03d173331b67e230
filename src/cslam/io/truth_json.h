// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/se3.h"
#include "cslam/io/json_reader.h"
#include "cslam/util/stamp.h"

#include <Eigen/Core>

#include <string>
#include <string_view>

// What the three truth files have in common.

namespace cslam {

constexpr int kMaxInstance = 65535;  // of a 16-bit image
constexpr int kMaxClass = 1'000'000;

// The file is of that format and of a version this program knows; otherwise Error.
void RequireFormat(const JsonValue& root, std::string_view format);

// "{\n  "format": ..., "version": ..., "sequence": ...": the start of every file, not closed.
std::string TruthHeader(std::string_view format, std::string_view sequence);

// Rounded to 9 decimals: nanometres, nanoseconds. The value must be finite.
std::string JsonNumber(double value);
std::string JsonArray(const Eigen::VectorXd& values);

// [tx, ty, tz, qx, qy, qz, qw], qw >= 0.
std::string JsonPose(const Se3& T);
Se3 ReadPose(const JsonValue& value);
// The same of 7 elements of a longer array.
Se3 ReadPose(const JsonValue& value, const std::vector<JsonValue>& items, std::size_t first);

Eigen::Vector3d ReadVector3(const JsonValue& value);

// "1.033333", as in file names and lists.
std::string JsonStamp(Stamp stamp);
Stamp ReadStamp(const JsonValue& value);

}  // namespace cslam
