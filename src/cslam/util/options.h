// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace cslam {

// Inclusive limits of a numeric option.
struct Range {
  double min = 0.0;
  double max = 0.0;
};

// One option: where its value lives and what a user may know about it.
struct OptionEntry {
  std::string key;  // full dotted path, e.g. "tracking.keyframe.min_inliers"
  std::variant<bool*, int*, double*, std::string*> value;
  Range range;       // of numbers; unused for bool and string
  std::string unit;  // "px", "m", "s", ...; empty for pure numbers
  std::string doc;   // one sentence
};

// The list of all options of a tree of plain structs. Each options struct has one free function
// beside it that names its fields once; YAML, --set, range errors, `changing-slam config` and
// docs/config.md all come from that list:
//
//   void Describe(OptionList& list, KeyframePolicyOptions& o) {
//     list.Add("min_inliers", o.min_inliers, {1, 10'000}, "matches", "fewest inliers to trust");
//   }
//
// The list points into the struct it was made from and must not outlive it.
class OptionList {
 public:
  void Add(std::string_view name, bool& value, std::string_view doc);
  void Add(std::string_view name, int& value, Range range, std::string_view unit,
           std::string_view doc);
  void Add(std::string_view name, double& value, Range range, std::string_view unit,
           std::string_view doc);
  void Add(std::string_view name, std::string& value, std::string_view doc);

  // Lists a nested struct's options under "name.".
  template <typename Options>
  void Group(std::string_view name, Options& options) {
    const std::size_t length = prefix_.size();
    prefix_ += name;
    prefix_ += '.';
    Describe(*this, options);
    prefix_.resize(length);
  }

  const std::vector<OptionEntry>& entries() const { return entries_; }

  // Parses text into the option called key. Throws Error that names the nearest valid key when
  // there is none of that name, the expected type, or the range that was missed.
  void Set(std::string_view key, std::string_view text);

  // Throws Error for the first value outside its range.
  void CheckRanges() const;

 private:
  std::string prefix_;
  std::vector<OptionEntry> entries_;
};

// The current value as --set and YAML take it back without loss.
std::string FormatValue(const OptionEntry& entry);

// The candidate with the smallest edit distance to name; empty if there are none.
std::string NearestName(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace cslam
