// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/scene_eval/assignment.h"

#include "cslam/util/check.h"

#include <algorithm>
#include <limits>

namespace cslam {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Square matrix in which every row has a partner; impossible pairs cost more than all others.
std::vector<std::vector<double>> Complete(const PairCosts& costs) {
  double sum = 1.0;
  std::size_t size = costs.size();
  for (const auto& row : costs) {
    size = std::max(size, row.size());
    for (const std::optional<double>& cost : row)
      sum += cost.value_or(0.0);
  }
  std::vector<std::vector<double>> matrix(size, std::vector<double>(size, sum));
  for (std::size_t i = 0; i < costs.size(); ++i)
    for (std::size_t j = 0; j < costs[i].size(); ++j)
      matrix[i][j] = costs[i][j].value_or(sum);
  return matrix;
}

// Shortest augmenting paths with potentials; row and column 0 are auxiliary.
class Hungarian {
 public:
  explicit Hungarian(const std::vector<std::vector<double>>& costs)
      : costs_(costs),
        row_potential_(costs.size() + 1, 0.0),
        column_potential_(costs.size() + 1, 0.0),
        row_of_(costs.size() + 1, 0),
        previous_(costs.size() + 1, 0) {}

  // The row (from 1) of each column (from 1).
  std::vector<std::size_t> Solve() {
    for (std::size_t row = 1; row <= costs_.size(); ++row)
      Augment(row);
    return row_of_;
  }

 private:
  void Augment(std::size_t row) {
    row_of_[0] = row;
    std::size_t column = 0;
    slack_.assign(costs_.size() + 1, kInfinity);
    is_used_.assign(costs_.size() + 1, false);
    while (row_of_[column] != 0) {
      is_used_[column] = true;
      column = Relax(column);
      Shift(slack_[column]);
    }
    for (; column != 0; column = previous_[column])
      row_of_[column] = row_of_[previous_[column]];
  }

  // Updates the slack of free columns through the row of one; returns that of least slack.
  std::size_t Relax(std::size_t column) {
    const std::size_t row = row_of_[column];
    std::size_t best = 0;
    for (std::size_t j = 1; j <= costs_.size(); ++j) {
      if (is_used_[j]) continue;
      const double reduced = costs_[row - 1][j - 1] - row_potential_[row] - column_potential_[j];
      if (reduced < slack_[j]) {
        slack_[j] = reduced;
        previous_[j] = column;
      }
      if (best == 0 || slack_[j] < slack_[best]) best = j;
    }
    return best;
  }

  void Shift(double delta) {
    for (std::size_t j = 0; j <= costs_.size(); ++j) {
      if (is_used_[j]) {
        row_potential_[row_of_[j]] += delta;
        column_potential_[j] -= delta;
      } else {
        slack_[j] -= delta;
      }
    }
  }

  const std::vector<std::vector<double>>& costs_;
  std::vector<double> row_potential_;
  std::vector<double> column_potential_;
  std::vector<std::size_t> row_of_;
  std::vector<std::size_t> previous_;
  std::vector<double> slack_;
  std::vector<bool> is_used_;
};

}  // namespace

std::vector<std::optional<std::size_t>> AssignPairs(const PairCosts& costs) {
  for (const auto& row : costs)
    CSLAM_CHECK(row.size() == costs.front().size());
  std::vector<std::optional<std::size_t>> columns(costs.size());
  const std::vector<std::vector<double>> matrix = Complete(costs);
  const std::vector<std::size_t> row_of = Hungarian(matrix).Solve();
  for (std::size_t column = 1; column < row_of.size(); ++column) {
    const std::size_t row = row_of[column] - 1;
    const bool is_real = row < costs.size() && column - 1 < costs[row].size();
    if (is_real && costs[row][column - 1]) columns[row] = column - 1;
  }
  return columns;
}

}  // namespace cslam
