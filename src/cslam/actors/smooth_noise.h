// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/util/random.h"

#include <array>

namespace cslam {

// A smooth random function of time without memory: mean 0, within -1 to 1, about one swing in
// period_s.
class SmoothNoise {
 public:
  SmoothNoise(double period_s, Rng& rng);
  double operator()(double time_s) const;

 private:
  struct Wave {
    double rate_rad_s = 0.0;
    double phase_rad = 0.0;
  };
  std::array<Wave, 3> waves_;
};

// 0 up to `low`, 1 from `high` on, with level ends.
double SmoothStep(double low, double high, double x);

}  // namespace cslam
