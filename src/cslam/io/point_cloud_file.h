// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace cslam {

struct ColoredPoint {
  Eigen::Vector3f position_m = Eigen::Vector3f::Zero();  // world frame
  std::array<std::uint8_t, 3> rgb = {0, 0, 0};
};

// Binary little-endian PLY with float x y z (metres) and uchar red green blue, which MeshLab,
// CloudCompare and Open3D open. Points that are not finite are left out. Each line of comment
// becomes one of the header. The file appears under its name only when complete.
void WritePointCloud(const std::filesystem::path& path, std::span<const ColoredPoint> points,
                     std::string_view comment = {});

}  // namespace cslam
