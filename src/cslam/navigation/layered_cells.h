// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace cslam {

// Evidence for and against each cell of a box, layer upon layer, in log-odds. One keyframe counts
// once for each cell, and a reading that ends there outweighs rays that only pass.
class LayeredCells {
 public:
  struct Shape {
    Eigen::Vector3d corner_m;  // of cell (0, 0, 0), grid frame
    Eigen::Vector3i size;      // cells along x, y, z
    Eigen::Vector3d cell_m;    // sides of a cell
  };
  struct Weights {
    double hit = 0.0;      // log-odds, positive
    double miss = 0.0;     // negative
    double limit = 0.0;    // of the sum, either way
    int min_readings = 1;  // for a hit
  };

  LayeredCells(const Shape& shape, const Weights& weights);

  // A reading at p; outside it counts for nothing.
  void AddHit(const Eigen::Vector3d& p);
  // The way from one point to another was free; the cell where it ends is left out.
  void AddRay(const Eigen::Vector3d& from, const Eigen::Vector3d& to);
  // A place that was seen to be free.
  void AddFree(const Eigen::Vector3d& p);
  // The end of a keyframe: first all its hits, then its rays, then this.
  void Apply();

  // Log-odds of a cell: 0 for one never seen.
  double At(int x, int y, int z) const;
  const Shape& shape() const { return shape_; }

 private:
  std::size_t IndexOf(const Eigen::Vector3i& cell) const;
  Eigen::Vector3i CellAt(const Eigen::Vector3d& p) const;
  bool IsInside(const Eigen::Vector3i& cell) const;
  void MarkFree(const Eigen::Vector3i& cell);

  Shape shape_;
  Weights weights_;
  std::vector<std::int8_t> evidence_;   // in units of kUnit
  std::vector<std::uint8_t> readings_;  // of the current keyframe; kFree: no hit
  std::vector<std::uint32_t> touched_;  // by the current keyframe
};

}  // namespace cslam
