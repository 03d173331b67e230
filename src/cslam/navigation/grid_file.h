// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/navigation/occupancy_grid.h"

#include <filesystem>
#include <string>

namespace cslam {

// The picture (binary PGM, first row on top: the largest y): occupied 0, free 254, unknown 205.
std::string FormatGridPgm(const OccupancyGrid& grid);

// What map_server reads beside it, and where the grid lies in the map. image: name of the picture.
std::string FormatGridYaml(const OccupancyGrid& grid, const std::string& image);

// Writes both: "room.yaml" gets "room.pgm" beside it. Each appears under its name only when
// complete, the YAML last. Throws Error.
void WriteOccupancyGrid(const std::filesystem::path& yaml, const OccupancyGrid& grid);

}  // namespace cslam
