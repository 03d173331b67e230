// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/util/check.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace cslam {

// The value of that rank if they were sorted. Move values in where they are of no more use.
template <typename T>
T ValueOfRank(std::vector<T> values, std::size_t rank) {
  CSLAM_CHECK(rank < values.size(), "rank {} of {} values", rank, values.size());
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// The value that this share of the others lies below, not interpolated: 0 asks for the least, 0.5
// for the lower of the two middle ones, 1 for the largest. There must be values.
template <typename T>
T QuantileOf(std::vector<T> values, double share) {
  CSLAM_CHECK(!values.empty());
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  return ValueOfRank(std::move(values), rank);
}

// The upper of the two middle values. There must be values.
template <typename T>
T MedianOf(std::vector<T> values) {
  const std::size_t rank = values.size() / 2;
  return ValueOfRank(std::move(values), rank);
}

template <typename T>
struct ValueRange {
  T min{};
  T max{};
  T length() const { return max - min; }
  T middle() const { return (min + max) / 2; }
};

// What the values lie between, the least num_out and the largest num_out of them left out. There
// must be more than twice as many. Move values in where they are of no more use.
template <typename T>
ValueRange<T> InnerRange(std::vector<T> values, std::size_t num_out) {
  CSLAM_CHECK(2 * num_out < values.size(), "{} of {} values", num_out, values.size());
  const auto min = values.begin() + static_cast<std::ptrdiff_t>(num_out);
  const auto max = values.end() - 1 - static_cast<std::ptrdiff_t>(num_out);
  std::nth_element(values.begin(), min, values.end());
  if (min != max) std::nth_element(min + 1, max, values.end());
  return {*min, *max};
}

}  // namespace cslam
