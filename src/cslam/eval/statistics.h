// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace cslam {

// Of errors, in their unit; sse in its square. All zero without errors.
struct ErrorStatistics {
  std::size_t count = 0;
  double rmse = 0.0;
  double mean = 0.0;
  double median = 0.0;  // mean of the middle two for an even count
  double std = 0.0;     // of the population: divided by count
  double min = 0.0;
  double max = 0.0;
  double sse = 0.0;
  std::size_t max_index = 0;  // of the first largest error
};

ErrorStatistics Summarise(std::span<const double> errors);

}  // namespace cslam
