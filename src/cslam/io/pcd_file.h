// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/io/point_cloud_file.h"

namespace cslam {

// Binary PCD 0.7 with float x y z (metres) and rgb packed into a float, which PCL, CloudCompare and
// Open3D open. Points that are not finite are left out. The file appears under its name only when
// complete.
void WritePcd(const std::filesystem::path& path, std::span<const ColoredPoint> points);

}  // namespace cslam
