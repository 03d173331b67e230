// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/vision/orb_distribute.h"

#include "cslam/vision/orb_simd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <tuple>

namespace cslam::orb {
namespace {

constexpr int kCellSize = 30;  // px
// Bounds the time on dense texture: candidates per cell, and per corner wanted.
constexpr std::size_t kMostPerCell = 16;
constexpr std::size_t kMostPerWanted = 4;

// A neighbour suppresses in full only if it is much stronger. Brown et al. have 0.9, which matches
// 1 % more but lets a patch of strong texture take most of the corners; 0.7 matches 1 % less.
constexpr float kRobustness = 0.8F;

bool IsBetter(const Candidate& a, const Candidate& b) {
  return std::tuple(b.score, a.y, a.x) < std::tuple(a.score, b.y, b.x);
}

// Candidates sorted by the cell of a grid they lie in.
struct Grid {
  // Cells have at least `cell_size` px on a side, unless the area is smaller.
  Grid(const std::vector<Candidate>& candidates, cv::Rect whole, int cell_size)
      : area(whole),
        columns(std::max(1, whole.width / cell_size)),
        rows(std::max(1, whole.height / cell_size)),
        begins(static_cast<std::size_t>(rows * columns) + 1),
        sorted(candidates.size()) {
    for (const Candidate& c : candidates)
      ++begins[Cell(Row(c), Column(c)) + 1];
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    std::vector<std::size_t> next = begins;
    for (const Candidate& c : candidates)
      sorted[next[Cell(Row(c), Column(c))]++] = c;
  }

  int Column(const Candidate& c) const { return (c.x - area.x) * columns / area.width; }
  int Row(const Candidate& c) const { return (c.y - area.y) * rows / area.height; }
  std::size_t Cell(int row, int column) const {
    return static_cast<std::size_t>(row * columns + column);
  }

  cv::Rect area;
  int columns;
  int rows;
  std::vector<std::size_t> begins;  // of each cell in sorted, and the end of the last
  std::vector<Candidate> sorted;
};

constexpr std::size_t kLanes = 8;
using Floats = float __attribute__((vector_size(32)));
static_assert(sizeof(Floats) == kLanes * sizeof(float));

// Candidates in columns, padded with scores of 0 to be read in groups of kLanes.
struct Columns {
  explicit Columns(const std::vector<Candidate>& candidates)
      : x(candidates.size() + kLanes), y(x.size()), score(x.size()) {
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      x[i] = candidates[i].x;
      y[i] = candidates[i].y;
      score[i] = candidates[i].score;
    }
  }
  std::vector<float> x, y, score;
};

CSLAM_KERNEL void Load(Floats& value, const std::vector<float>& column, std::size_t i) {
  std::memcpy(&value, column.data() + i, sizeof(value));
}

// The smallest squared suppression radius that candidate i gets from those in [begin, end), or
// `largest`. Up to kLanes - 1 candidates after the end take part.
CSLAM_KERNEL float RadiusSquared(const Columns& columns, std::size_t i, std::size_t begin,
                                 std::size_t end, float largest) {
  const float score_i = columns.score[i];
  Floats smallest = Floats{} + largest;
  for (std::size_t j = begin; j < end; j += kLanes) {
    Floats dx, dy, score;
    Load(dx, columns.x, j);
    Load(dy, columns.y, j);
    Load(score, columns.score, j);
    dx -= columns.x[i];
    dy -= columns.y[i];
    const Floats distance2 = dx * dx + dy * dy;
    const Floats stretch = score / (score - kRobustness * score_i);
    const Floats radius2 = distance2 * (stretch * stretch);
    const auto suppresses = (score >= score_i) & (distance2 > 0.0F) & (radius2 < smallest);
    smallest = suppresses ? radius2 : smallest;
  }
  float result = largest;
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    result = std::min(result, smallest[lane]);
  return result;
}

// Of each candidate of the grid; only candidates in the same or a neighbouring cell count.
CSLAM_KERNEL std::vector<float> RadiiSquared(const Grid& grid, float largest) {
  const Columns columns(grid.sorted);
  std::vector<float> radii2(grid.sorted.size(), largest);
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const int left = std::max(column - 1, 0);
      const int right = std::min(column + 1, grid.columns - 1);
      const std::size_t cell = grid.Cell(row, column);
      for (std::size_t i = grid.begins[cell]; i < grid.begins[cell + 1]; ++i) {
        for (int r = std::max(row - 1, 0); r <= std::min(row + 1, grid.rows - 1); ++r) {
          radii2[i] = RadiusSquared(columns, i, grid.begins[grid.Cell(r, left)],
                                    grid.begins[grid.Cell(r, right) + 1], radii2[i]);
        }
      }
    }
  }
  return radii2;
}

std::vector<float> RadiiSquaredBaseline(const Grid& grid, float largest) {
  return RadiiSquared(grid, largest);
}

CSLAM_TARGET_AVX2 std::vector<float> RadiiSquaredAvx2(const Grid& grid, float largest) {
  return RadiiSquared(grid, largest);
}

}  // namespace

std::vector<Candidate> ThinOut(const std::vector<Candidate>& candidates, cv::Rect area, int score,
                               int count) {
  Grid grid(candidates, area, kCellSize);
  const std::size_t cells = grid.begins.size() - 1;
  const std::size_t wanted = static_cast<std::size_t>(std::max(count, 0));
  const std::size_t most = std::max(kMostPerCell, kMostPerWanted * wanted / cells);
  std::vector<Candidate> kept;
  kept.reserve(candidates.size());
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const auto begin = grid.sorted.begin() + static_cast<std::ptrdiff_t>(grid.begins[cell]);
    const auto end = grid.sorted.begin() + static_cast<std::ptrdiff_t>(grid.begins[cell + 1]);
    if (begin == end) continue;
    auto strong_end =
        std::partition(begin, end, [score](const Candidate& c) { return c.score > score; });
    if (strong_end == begin) {
      kept.push_back(*std::min_element(begin, end, IsBetter));
      continue;
    }
    const auto most_end = begin + static_cast<std::ptrdiff_t>(most);
    if (strong_end - begin > most_end - begin) {
      std::nth_element(begin, most_end, strong_end, IsBetter);
      strong_end = most_end;
    }
    kept.insert(kept.end(), begin, strong_end);
  }
  return kept;
}

std::vector<Candidate> SelectEvenly(const std::vector<Candidate>& candidates, cv::Rect area,
                                    int count, Simd simd) {
  const auto wanted = static_cast<std::size_t>(std::max(count, 0));
  if (candidates.size() <= wanted) return candidates;
  if (wanted == 0) return {};
  // More than the spacing of `wanted` corners on a square grid: larger radii need not be told
  // apart.
  const double largest =
      1.5 * std::sqrt(static_cast<double>(area.area()) / static_cast<double>(wanted));
  const Grid grid(candidates, area, static_cast<int>(std::ceil(largest)));
  const auto largest2 = static_cast<float>(largest * largest);
  const std::vector<float> radii2 =
      simd == Simd::kAvx2 ? RadiiSquaredAvx2(grid, largest2) : RadiiSquaredBaseline(grid, largest2);
  std::vector<std::size_t> order(radii2.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(wanted), order.end(),
                   [&](std::size_t a, std::size_t b) {
                     if (radii2[a] != radii2[b]) return radii2[a] > radii2[b];
                     return IsBetter(grid.sorted[a], grid.sorted[b]);
                   });
  std::vector<Candidate> selected;
  selected.reserve(wanted);
  for (std::size_t i = 0; i < wanted; ++i)
    selected.push_back(grid.sorted[order[i]]);
  return selected;
}

std::vector<int> SplitCount(int total, const std::vector<double>& shares,
                            const std::vector<int>& available) {
  std::vector<int> counts(shares.size(), 0);
  std::vector<bool> is_open(shares.size(), true);
  // Each round fills at least one level or ends.
  for (int left = total; left > 0;) {
    double open_shares = 0.0;
    for (std::size_t i = 0; i < shares.size(); ++i)
      open_shares += is_open[i] ? shares[i] : 0.0;
    if (open_shares <= 0.0) break;
    double exact = 0.0;
    int given = 0;
    int used = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      if (!is_open[i]) continue;
      exact += left * shares[i] / open_shares;
      const int part = static_cast<int>(exact + 0.5) - given;
      given += part;
      const int taken = std::min(part, available[i] - counts[i]);
      counts[i] += taken;
      used += taken;
      is_open[i] = counts[i] < available[i];
    }
    left -= used;
    if (used == 0) break;
  }
  return counts;
}

}  // namespace cslam::orb
