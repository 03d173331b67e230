// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/util/options.h"

#include "cslam/util/check.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <system_error>
#include <utility>

namespace cslam {
namespace {

Error RangeError(const OptionEntry& entry, std::string_view value) {
  return Error("{} = {} is outside {} to {}{}", entry.key, value, entry.range.min, entry.range.max,
               entry.unit.empty() ? "" : fmt::format(" ({})", entry.unit));
}

bool IsInside(double value, Range range) {
  return value >= range.min && value <= range.max;  // false for NaN
}

std::string_view WithoutPlus(std::string_view text) {
  const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  return has_plus ? text.substr(1) : text;
}

bool ParseBool(const OptionEntry& entry, std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  constexpr std::array<std::string_view, 4> kTrue = {"true", "yes", "on", "1"};
  constexpr std::array<std::string_view, 4> kFalse = {"false", "no", "off", "0"};
  if (std::ranges::find(kTrue, lower) != kTrue.end()) return true;
  if (std::ranges::find(kFalse, lower) != kFalse.end()) return false;
  throw Error("{} = '{}' is neither true nor false", entry.key, text);
}

int ParseInt(const OptionEntry& entry, std::string_view text) {
  const std::string_view digits = WithoutPlus(text);
  const char* const last = digits.data() + digits.size();
  int value = 0;
  const auto [end, error] = std::from_chars(digits.data(), last, value);
  if (end != last || error == std::errc::invalid_argument)
    throw Error("{} = '{}' is not a whole number", entry.key, text);
  if (error != std::errc() || !IsInside(value, entry.range)) throw RangeError(entry, text);
  return value;
}

double ParseDouble(const OptionEntry& entry, std::string_view text) {
  const std::string_view digits = WithoutPlus(text);
  const char* const last = digits.data() + digits.size();
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), last, value);
  if (end != last || error != std::errc() || !std::isfinite(value))
    throw Error("{} = '{}' is not a finite number", entry.key, text);
  if (!IsInside(value, entry.range)) throw RangeError(entry, text);
  return value;
}

// Insertions, deletions, substitutions and swaps of neighbours that turn a into b.
std::size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j)
    row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last = std::exchange(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + substitution});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string_view LastComponent(std::string_view key) {
  return key.substr(key.rfind('.') + 1);  // npos + 1 is 0
}

// The smaller the nearer. The right name in the wrong group counts as one edit; among equals
// the whole key decides.
std::pair<std::size_t, std::size_t> NameDistance(std::string_view name,
                                                 std::string_view candidate) {
  const std::size_t whole = EditDistance(name, candidate);
  const std::size_t last = EditDistance(LastComponent(name), LastComponent(candidate));
  return {std::min(whole, last + 1), whole};
}

void AddEntry(std::vector<OptionEntry>& entries, OptionEntry entry) {
  for (const OptionEntry& other : entries) {
    CSLAM_CHECK(other.key != entry.key, "option {} is described twice", entry.key);
  }
  CSLAM_CHECK(entry.range.min <= entry.range.max, "option {} has an empty range", entry.key);
  entries.push_back(std::move(entry));
}

}  // namespace

void OptionList::Add(std::string_view name, bool& value, std::string_view doc) {
  AddEntry(entries_, {prefix_ + std::string(name), &value, {}, {}, std::string(doc)});
}

void OptionList::Add(std::string_view name, int& value, Range range, std::string_view unit,
                     std::string_view doc) {
  AddEntry(entries_,
           {prefix_ + std::string(name), &value, range, std::string(unit), std::string(doc)});
}

void OptionList::Add(std::string_view name, double& value, Range range, std::string_view unit,
                     std::string_view doc) {
  AddEntry(entries_,
           {prefix_ + std::string(name), &value, range, std::string(unit), std::string(doc)});
}

void OptionList::Add(std::string_view name, std::string& value, std::string_view doc) {
  AddEntry(entries_, {prefix_ + std::string(name), &value, {}, {}, std::string(doc)});
}

void OptionList::Set(std::string_view key, std::string_view text) {
  const auto entry = std::ranges::find(entries_, key, &OptionEntry::key);
  if (entry == entries_.end()) {
    std::vector<std::string> keys;
    for (const OptionEntry& candidate : entries_)
      keys.push_back(candidate.key);
    const std::string nearest = NearestName(key, keys);
    throw Error("unknown option '{}'{}", key,
                nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest));
  }
  if (bool* const* flag = std::get_if<bool*>(&entry->value)) {
    **flag = ParseBool(*entry, text);
  } else if (int* const* integer = std::get_if<int*>(&entry->value)) {
    **integer = ParseInt(*entry, text);
  } else if (double* const* real = std::get_if<double*>(&entry->value)) {
    **real = ParseDouble(*entry, text);
  } else {
    *std::get<std::string*>(entry->value) = text;
  }
}

void OptionList::CheckRanges() const {
  for (const OptionEntry& entry : entries_) {
    if (int* const* integer = std::get_if<int*>(&entry.value)) {
      if (!IsInside(**integer, entry.range)) throw RangeError(entry, FormatValue(entry));
    } else if (double* const* real = std::get_if<double*>(&entry.value)) {
      if (!IsInside(**real, entry.range)) throw RangeError(entry, FormatValue(entry));
    }
  }
}

std::string FormatValue(const OptionEntry& entry) {
  if (bool* const* flag = std::get_if<bool*>(&entry.value)) return **flag ? "true" : "false";
  if (int* const* integer = std::get_if<int*>(&entry.value)) return fmt::format("{}", **integer);
  if (double* const* real = std::get_if<double*>(&entry.value)) return fmt::format("{}", **real);
  return *std::get<std::string*>(entry.value);
}

std::string NearestName(std::string_view name, const std::vector<std::string>& candidates) {
  if (candidates.empty()) return {};
  return *std::ranges::min_element(candidates, {}, [name](const std::string& candidate) {
    return NameDistance(name, candidate);
  });
}

}  // namespace cslam
