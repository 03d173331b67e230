// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/navigation/grid_file.h"

#include "cslam/util/atomic_file.h"

#include <fmt/format.h>

namespace cslam {
namespace {

// What ROS' map_saver writes; map_server tells the three apart by the thresholds below.
constexpr char kOccupiedPixel = '\x00';
constexpr char kFreePixel = '\xFE';
constexpr char kUnknownPixel = '\xCD';
constexpr double kOccupiedThreshold = 0.65;
constexpr double kFreeThreshold = 0.196;

char PixelOf(CellState state) {
  switch (state) {
    case CellState::kOccupied:
      return kOccupiedPixel;
    case CellState::kFree:
      return kFreePixel;
    case CellState::kUnknown:
      break;
  }
  return kUnknownPixel;
}

}  // namespace

std::string FormatGridPgm(const OccupancyGrid& grid) {
  std::string pgm = fmt::format("P5\n{} {}\n255\n", grid.width, grid.height);
  for (int y = grid.height - 1; y >= 0; --y) {
    for (int x = 0; x < grid.width; ++x) {
      const auto index = static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) +
                         static_cast<std::size_t>(x);
      pgm += PixelOf(grid.cells[index]);
    }
  }
  return pgm;
}

std::string FormatGridYaml(const OccupancyGrid& grid, const std::string& image) {
  const Eigen::Vector3d& t = grid.T_grid_world.translation;
  const Eigen::Quaterniond& q = grid.T_grid_world.rotation;
  std::string yaml = fmt::format(
      "image: {}\nresolution: {}\norigin: [{:.6f}, {:.6f}, 0.0]\nnegate: 0\n"
      "occupied_thresh: {}\nfree_thresh: {}\nmode: trinary\n",
      image, grid.resolution_m, grid.origin_m.x(), grid.origin_m.y(), kOccupiedThreshold,
      kFreeThreshold);
  if (!grid.has_floor) yaml += "# no floor was seen: its height is only assumed\n";
  yaml += fmt::format(
      "# From the world of trajectory.txt to the grid (z up, the floor at 0):\n"
      "# tx ty tz qx qy qz qw\n"
      "T_grid_world: [{:.6f}, {:.6f}, {:.6f}, {:.9f}, {:.9f}, {:.9f}, {:.9f}]\n",
      t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
  return yaml;
}

void WriteOccupancyGrid(const std::filesystem::path& yaml, const OccupancyGrid& grid) {
  std::filesystem::path picture = yaml;
  picture.replace_extension(".pgm");
  WriteFileAtomically(picture, FormatGridPgm(grid));
  WriteFileAtomically(yaml, FormatGridYaml(grid, picture.filename().string()));
}

}  // namespace cslam
