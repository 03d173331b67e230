// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace cslam {

// Wall-clock time since construction or the last Lap(). For reports only: no decision of SLAM may
// depend on it.
class Stopwatch {
 public:
  double ElapsedMs() const {
    return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }

  // Time since the last lap, and starts the next.
  double LapMs() {
    const double elapsed = ElapsedMs();
    start_ = Clock::now();
    return elapsed;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace cslam
