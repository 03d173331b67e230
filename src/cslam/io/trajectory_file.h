// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/geometry/trajectory.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace cslam {

// TUM trajectory files: one pose a line, "timestamp tx ty tz qx qy qz qw" (seconds, metres, unit
// quaternion; camera to world), separated by blanks. Lines that start with '#' and empty lines
// are skipped; CR LF line ends and a UTF-8 byte order mark are fine.
//
// Throws Error with file:line for a line that is not 8 finite numbers, a quaternion whose length
// differs from 1 by more than 0.01, and a timestamp that does not come after the one before it.
// A file without poses gives an empty trajectory.
Trajectory ReadTrajectory(const std::filesystem::path& path);

// The same from text; name stands for the file in errors.
Trajectory ParseTrajectory(std::string_view text, std::string_view name);

// Timestamps with 6 decimals, metres with 7, quaternions with 9 (w >= 0). Each line of comment
// comes first, after "# ". Poses must be finite and their stamps strictly increasing.
std::string FormatTrajectory(const Trajectory& trajectory, std::string_view comment = {});

// The file appears under its name only when complete.
void WriteTrajectory(const std::filesystem::path& path, const Trajectory& trajectory,
                     std::string_view comment = {});

}  // namespace cslam
