// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/util/stamp.h"

#include "cslam/util/check.h"

#include <charconv>
#include <cmath>

namespace cslam {
namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

std::int64_t PowerOfTen(int exponent) {
  std::int64_t power = 1;
  for (int i = 0; i < exponent; ++i)
    power *= 10;
  return power;
}

// Plain decimals are read digit by digit, so no precision is lost.
std::optional<Stamp> ParseDecimal(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  std::int64_t seconds = 0;
  std::int64_t fraction = 0;
  int decimals = -1;  // -1: the point has not been seen
  int digits = 0;
  bool round_up = false;
  for (const char c : text) {
    if (c == '.' && decimals < 0) {
      decimals = 0;
      continue;
    }
    if (c < '0' || c > '9') return std::nullopt;
    const int digit = c - '0';
    ++digits;
    if (decimals < 0) {
      if (seconds > 900'000'000) {
        if (seconds > 9'000'000'000) return std::nullopt;  // beyond what int64 nanoseconds hold
      }
      seconds = 10 * seconds + digit;
    } else if (decimals < 9) {
      fraction = 10 * fraction + digit;
      ++decimals;
    } else if (decimals == 9) {
      round_up = digit >= 5;
      ++decimals;
    }
  }
  if (digits == 0 || seconds > 9'000'000'000) return std::nullopt;
  const int kept = decimals < 0 ? 0 : (decimals > 9 ? 9 : decimals);
  const std::int64_t ns =
      seconds * kNsPerSecond + fraction * PowerOfTen(9 - kept) + (round_up ? 1 : 0);
  return Stamp{negative ? -ns : ns};
}

}  // namespace

std::optional<Stamp> ParseStamp(std::string_view text) {
  if (text.find_first_of("eE") == std::string_view::npos) return ParseDecimal(text);
  // Scientific notation, as some tools write it ("1.305031e+09"): exact to a double.
  double seconds = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (!std::isfinite(seconds) || std::abs(seconds) > 9e9) return std::nullopt;
  return Stamp{std::llround(seconds * 1e9)};
}

std::string FormatStamp(Stamp stamp, int decimals) {
  CSLAM_CHECK(decimals >= 0 && decimals <= 9, "decimals {}", decimals);
  const bool negative = stamp.ns < 0;
  const std::int64_t unit = PowerOfTen(9 - decimals);
  const std::int64_t rounded = ((negative ? -stamp.ns : stamp.ns) + unit / 2) / unit;
  const std::int64_t per_second = PowerOfTen(decimals);
  const char* sign = negative && rounded != 0 ? "-" : "";
  if (decimals == 0) return fmt::format("{}{}", sign, rounded);
  return fmt::format("{}{}.{:0{}}", sign, rounded / per_second, rounded % per_second, decimals);
}

}  // namespace cslam
