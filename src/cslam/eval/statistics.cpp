// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/eval/statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cslam {

ErrorStatistics Summarise(std::span<const double> errors) {
  ErrorStatistics s;
  if (errors.empty()) return s;
  s.count = errors.size();
  const double n = static_cast<double>(errors.size());
  for (const double e : errors) {
    s.sse += e * e;
    s.mean += e / n;
  }
  s.rmse = std::sqrt(s.sse / n);
  double variance = 0.0;
  for (const double e : errors)
    variance += (e - s.mean) * (e - s.mean) / n;
  s.std = std::sqrt(variance);

  std::vector<double> sorted(errors.begin(), errors.end());
  std::sort(sorted.begin(), sorted.end());
  s.min = sorted.front();
  s.max = sorted.back();
  s.median = 0.5 * (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]);
  s.max_index = static_cast<std::size_t>(
      std::distance(errors.begin(), std::max_element(errors.begin(), errors.end())));
  return s;
}

}  // namespace cslam
