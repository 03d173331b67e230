// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/navigation/layered_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cslam {
namespace {

constexpr double kUnit = 0.05;  // of log-odds; an int8_t holds up to 6.35: a belief of 0.998
constexpr std::uint8_t kFree = 255;

}  // namespace

LayeredCells::LayeredCells(const Shape& shape, const Weights& weights)
    : shape_(shape), weights_(weights) {
  const auto count = static_cast<std::size_t>(shape.size.x()) *
                     static_cast<std::size_t>(shape.size.y()) *
                     static_cast<std::size_t>(shape.size.z());
  evidence_.assign(count, 0);
  readings_.assign(count, 0);
}

std::size_t LayeredCells::IndexOf(const Eigen::Vector3i& cell) const {
  const auto row = static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(shape_.size.x()) +
                   static_cast<std::size_t>(cell.x());
  return row * static_cast<std::size_t>(shape_.size.z()) + static_cast<std::size_t>(cell.z());
}

Eigen::Vector3i LayeredCells::CellAt(const Eigen::Vector3d& p) const {
  return ((p - shape_.corner_m).array() / shape_.cell_m.array()).floor().cast<int>();
}

bool LayeredCells::IsInside(const Eigen::Vector3i& cell) const {
  return (cell.array() >= 0).all() && (cell.array() < shape_.size.array()).all();
}

void LayeredCells::AddHit(const Eigen::Vector3d& p) {
  const Eigen::Vector3i cell = CellAt(p);
  if (!IsInside(cell)) return;
  const std::size_t index = IndexOf(cell);
  if (readings_[index] == 0) touched_.push_back(static_cast<std::uint32_t>(index));
  if (readings_[index] < kFree - 1) ++readings_[index];
}

void LayeredCells::MarkFree(const Eigen::Vector3i& cell) {
  if (!IsInside(cell)) return;
  const std::size_t index = IndexOf(cell);
  if (readings_[index] != 0) return;
  readings_[index] = kFree;
  touched_.push_back(static_cast<std::uint32_t>(index));
}

// Walks from cell border to cell border (Amanatides and Woo, 1987).
void LayeredCells::AddRay(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d start = (from - shape_.corner_m).array() / shape_.cell_m.array();
  const Eigen::Vector3d end = (to - shape_.corner_m).array() / shape_.cell_m.array();
  const Eigen::Vector3d way = end - start;
  Eigen::Vector3i cell = start.array().floor().cast<int>();
  const Eigen::Vector3i last = end.array().floor().cast<int>();
  Eigen::Vector3i step;
  Eigen::Vector3d next;   // share of the way at which the ray enters the next cell, by axis
  Eigen::Vector3d delta;  // share of the way across one cell
  for (int axis = 0; axis < 3; ++axis) {
    step[axis] = way[axis] > 0.0 ? 1 : -1;
    const bool is_across = std::abs(way[axis]) < 1e-12;
    delta[axis] = is_across ? std::numeric_limits<double>::infinity() : 1.0 / std::abs(way[axis]);
    const double border = way[axis] > 0.0 ? cell[axis] + 1.0 : cell[axis];
    next[axis] =
        is_across ? std::numeric_limits<double>::infinity() : (border - start[axis]) / way[axis];
  }
  const int num_cells = (last - cell).cwiseAbs().sum();
  for (int i = 0; i < num_cells; ++i) {
    MarkFree(cell);
    int axis = 0;
    next.minCoeff(&axis);
    cell[axis] += step[axis];
    next[axis] += delta[axis];
  }
}

void LayeredCells::AddFree(const Eigen::Vector3d& p) {
  MarkFree(CellAt(p));
}

void LayeredCells::Apply() {
  const double limit = std::min(weights_.limit / kUnit, 127.0);
  for (const std::uint32_t index : touched_) {
    const int readings = readings_[index];
    readings_[index] = 0;
    const bool is_hit = readings != kFree;
    if (is_hit && readings < weights_.min_readings) continue;
    const double sum = evidence_[index] + (is_hit ? weights_.hit : weights_.miss) / kUnit;
    evidence_[index] = static_cast<std::int8_t>(std::lround(std::clamp(sum, -limit, limit)));
  }
  touched_.clear();
}

double LayeredCells::At(int x, int y, int z) const {
  return kUnit * evidence_[IndexOf({x, y, z})];
}

}  // namespace cslam
