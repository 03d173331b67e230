// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cslam {

// A JSON object that is only written. Fields keep their order; keys must differ.
class JsonObject {
 public:
  void Add(std::string_view key, std::string_view text);
  void Add(std::string_view key, const char* text) { Add(key, std::string_view(text)); }
  void Add(std::string_view key, const std::vector<std::string>& texts);
  void Add(std::string_view key, bool value);
  void Add(std::string_view key, double value);  // 9 digits; null unless finite
  void Add(std::string_view key, const JsonObject& object);
  void AddNull(std::string_view key);

  template <std::integral Integer>
  void Add(std::string_view key, Integer value) {
    AddRaw(key, std::to_string(value));
  }

  // null when absent.
  template <typename T>
  void Add(std::string_view key, const std::optional<T>& value) {
    value ? Add(key, *value) : AddNull(key);
  }

  // Indented by two blanks, without a final newline.
  std::string Text() const;

 private:
  void AddRaw(std::string_view key, std::string json);

  std::vector<std::pair<std::string, std::string>> fields_;  // key and value, both as JSON
};

// What stands between the brackets of an array of them, not indented.
std::string JsonItems(std::span<const JsonObject> items);

}  // namespace cslam
