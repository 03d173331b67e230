// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/navigation/floor.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cslam {

class OptionList;

struct OccupancyGridOptions {
  double resolution_m = 0.05;     // side of a cell
  double layer_m = 0.10;          // cells are counted in layers so thick
  double min_height_m = 0.10;     // of obstacles above the floor
  double max_height_m = 1.80;     // what a robot passes under
  double max_depth_m = 4.0;       // farther readings scatter
  double hit_probability = 0.7;   // that a cell is occupied, given that a reading ends in it
  double miss_probability = 0.4;  // ... that a ray passes through
  double max_belief = 0.97;       // what many readings amount to at most, so that change is learned
  double occupied_belief = 0.75;  // two hits
  double free_belief = 0.35;      // two rays
  int min_readings = 2;           // of one keyframe that end in a cell, for one hit
  double region_margin_m = 0.05;  // around regions to leave out
  FloorOptions floor = {};
};
void Describe(OptionList& list, OccupancyGridOptions& options);

enum class CellState : std::uint8_t { kUnknown, kFree, kOccupied };

// Where a robot may go, seen from above. Grid frame: z up from the floor, x along the view of the
// map's origin, y to its left.
struct OccupancyGrid {
  double resolution_m = 0.05;
  int width = 0;                                       // cells along x
  int height = 0;                                      // along y
  Eigen::Vector2d origin_m = Eigen::Vector2d::Zero();  // corner of cell (0, 0), grid frame
  Se3 T_grid_world;
  bool has_floor = false;        // false: the floor was not seen but assumed
  std::vector<CellState> cells;  // row by row, y upwards

  // Unknown outside.
  CellState At(const Eigen::Vector2d& p_grid) const;
};

// A box whose surface is gone, and since when.
struct ClearedRegion {
  Se3 T_world_box;
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
  KeyframeId last_seen = {};  // the last keyframe that saw it there; invalid: all readings are old
};

// Where objects of a map stood that are gone.
std::vector<ClearedRegion> AbsentObjects(const MapView& map, MapId map_id);

// From the depth of one map's keyframes. Rays are cast through layers of cells (log-odds), and a
// cell is occupied if one of its layers within the band of heights is. Readings on what stood in
// the cleared regions are no obstacles, but the way up to them was free. nullopt if no keyframe
// has depth. Throws Error if the map is too large for the resolution.
std::optional<OccupancyGrid> BuildOccupancyGrid(const MapView& map, MapId map_id,
                                                const Camera& camera,
                                                std::span<const ClearedRegion> cleared,
                                                const OccupancyGridOptions& options);

}  // namespace cslam
