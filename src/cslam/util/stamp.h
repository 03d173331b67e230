// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cslam {

// A point in time: nanoseconds since the data set's own epoch. Exact, unlike a double.
struct Stamp {
  std::int64_t ns = 0;

  constexpr auto operator<=>(const Stamp&) const = default;
};

// a - b in seconds.
constexpr double SecondsBetween(Stamp a, Stamp b) {
  return 1e-9 * static_cast<double>(a.ns - b.ns);
}

// Whether enough time has passed; clocks that jump back, and those of other recordings, count as
// such.
constexpr bool HasPassed(Stamp since, Stamp now, double interval_s) {
  constexpr double kSlackS = 1e-3;
  const double passed_s = SecondsBetween(now, since);
  return passed_s < 0.0 || passed_s >= interval_s - kSlackS;
}

constexpr Stamp operator+(Stamp stamp, std::int64_t ns) {
  return Stamp{stamp.ns + ns};
}

// "1305031453.359684" -> exact nanoseconds; digits beyond the ninth decimal are rounded.
// nullopt unless the whole text is one finite decimal number.
std::optional<Stamp> ParseStamp(std::string_view text);

// Seconds with the given number of decimals (0 to 9), rounded half up.
std::string FormatStamp(Stamp stamp, int decimals = 6);

}  // namespace cslam
