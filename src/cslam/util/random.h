// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace cslam {

// A small, fast generator (SplitMix64) whose sequence is the same with every compiler and
// library, unlike the std:: distributions. Seed one per use: Rng(seed, frame, purpose).
class Rng {
 public:
  explicit constexpr Rng(std::uint64_t seed, std::uint64_t stream = 0, std::uint64_t purpose = 0)
      : state_(Mix(Mix(Mix(seed) ^ stream) ^ purpose)) {}

  constexpr std::uint64_t NextUint64() {
    state_ += 0x9E3779B97F4A7C15ULL;
    return Mix(state_);
  }

  // In [0, 1).
  constexpr double Uniform() { return static_cast<double>(NextUint64() >> 11) * 0x1.0p-53; }
  constexpr double Uniform(double low, double high) { return low + (high - low) * Uniform(); }

  // In [0, count); count must be positive.
  constexpr std::uint64_t Index(std::uint64_t count) { return NextUint64() % count; }

  // Standard normal (Box-Muller).
  double Gaussian() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - Uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * Uniform());
  }

 private:
  static constexpr std::uint64_t Mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace cslam
