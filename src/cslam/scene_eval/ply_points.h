// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <vector>

namespace cslam {

// The places of the vertices of a binary little-endian PLY file, m. The vertices come first in the
// file, have scalar properties only, and among these float or double x, y and z. Throws Error with
// the path and the reason for anything else, and for a file that ends early.
std::vector<Eigen::Vector3d> ReadPlyPoints(const std::filesystem::path& file);

}  // namespace cslam
