// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ctime>

namespace cslam {

struct LapTime {
  double wall_ms = 0.0;
  double cpu_ms = 0.0;  // of the calling thread
};

// Time since construction or the last Lap(), on the wall and of the calling thread. For reports
// only: no decision of SLAM may depend on it.
class Stopwatch {
 public:
  LapTime Elapsed() const {
    return {.wall_ms = NowMs(CLOCK_MONOTONIC) - wall_start_ms_,
            .cpu_ms = NowMs(CLOCK_THREAD_CPUTIME_ID) - cpu_start_ms_};
  }

  double ElapsedMs() const { return Elapsed().wall_ms; }

  // Time since the last lap, and starts the next.
  LapTime Lap() {
    const LapTime elapsed = Elapsed();
    wall_start_ms_ += elapsed.wall_ms;
    cpu_start_ms_ += elapsed.cpu_ms;
    return elapsed;
  }

 private:
  static double NowMs(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
  }

  double wall_start_ms_ = NowMs(CLOCK_MONOTONIC);
  double cpu_start_ms_ = NowMs(CLOCK_THREAD_CPUTIME_ID);
};

}  // namespace cslam
