// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/actors/smooth_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cslam {

SmoothNoise::SmoothNoise(double period_s, Rng& rng) {
  constexpr std::array<double, 3> kRates{0.61, 1.0, 1.73};  // no common period worth noticing
  for (std::size_t i = 0; i < waves_.size(); ++i) {
    const double rate_hz = kRates[i] * rng.Uniform(0.85, 1.15) / period_s;
    waves_[i] = {2.0 * std::numbers::pi * rate_hz, rng.Uniform(0.0, 2.0 * std::numbers::pi)};
  }
}

double SmoothNoise::operator()(double time_s) const {
  constexpr std::array<double, 3> kWeights{0.45, 0.35, 0.2};
  double sum = 0.0;
  for (std::size_t i = 0; i < waves_.size(); ++i)
    sum += kWeights[i] * std::sin(waves_[i].rate_rad_s * time_s + waves_[i].phase_rad);
  return sum;
}

double SmoothStep(double low, double high, double x) {
  const double u = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

}  // namespace cslam
