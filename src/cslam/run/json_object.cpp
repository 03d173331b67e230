// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/json_object.h"

#include <fmt/format.h>

#include <cmath>

namespace cslam {
namespace {

bool IsContinuation(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

// Length of the UTF-8 sequence text begins with; 0 if it begins with none. File names may hold any
// bytes, JSON only Unicode.
std::size_t Utf8Length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  if (lead < 0x80U) return 1;
  const std::size_t length = lead >= 0xF0U ? 4 : lead >= 0xE0U ? 3 : 2;
  if (lead < 0xC2U || lead > 0xF4U || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if (!IsContinuation(text[i])) return 0;
  }
  const auto second = static_cast<unsigned char>(text[1]);
  const bool is_overlong = (lead == 0xE0U && second < 0xA0U) || (lead == 0xF0U && second < 0x90U);
  const bool is_out_of_range =
      (lead == 0xEDU && second > 0x9FU) || (lead == 0xF4U && second > 0x8FU);
  return is_overlong || is_out_of_range ? 0 : length;
}

std::string Quote(std::string_view text) {
  std::string quoted = "\"";
  while (!text.empty()) {
    const std::size_t length = Utf8Length(text);
    const char c = text.front();
    if (length == 0) {
      quoted += "\\ufffd";
    } else if (c == '"' || c == '\\') {
      quoted += {'\\', c};
    } else if (length == 1 && static_cast<unsigned char>(c) < 0x20U) {
      quoted += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      quoted += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return quoted + '"';
}

// Line breaks in JSON are only between values, never inside of texts.
std::string Indent(std::string_view json) {
  std::string indented;
  for (const char c : json) {
    indented += c;
    if (c == '\n') indented += "  ";
  }
  return indented;
}

std::string Enclose(char open, const std::vector<std::string>& items, char close) {
  if (items.empty()) return {open, close};
  std::string text(1, open);
  for (std::size_t i = 0; i < items.size(); ++i)
    text += fmt::format("{}\n  {}", i == 0 ? "" : ",", Indent(items[i]));
  return text + '\n' + close;
}

}  // namespace

void JsonObject::Add(std::string_view key, std::string_view text) {
  AddRaw(key, Quote(text));
}

void JsonObject::Add(std::string_view key, const std::vector<std::string>& texts) {
  std::vector<std::string> items;
  items.reserve(texts.size());
  for (const std::string& text : texts)
    items.push_back(Quote(text));
  AddRaw(key, Enclose('[', items, ']'));
}

void JsonObject::Add(std::string_view key, bool value) {
  AddRaw(key, value ? "true" : "false");
}

void JsonObject::Add(std::string_view key, double value) {
  AddRaw(key, std::isfinite(value) ? fmt::format("{:.9g}", value) : "null");
}

void JsonObject::Add(std::string_view key, const JsonObject& object) {
  AddRaw(key, object.Text());
}

void JsonObject::AddNull(std::string_view key) {
  AddRaw(key, "null");
}

void JsonObject::AddRaw(std::string_view key, std::string json) {
  fields_.emplace_back(Quote(key), std::move(json));
}

std::string JsonObject::Text() const {
  std::vector<std::string> items;
  items.reserve(fields_.size());
  for (const auto& [key, value] : fields_)
    items.push_back(fmt::format("{}: {}", key, value));
  return Enclose('{', items, '}');
}

std::string JsonItems(std::span<const JsonObject> items) {
  std::string text;
  for (const JsonObject& item : items)
    text += fmt::format("{}{}", text.empty() ? "" : ",\n", item.Text());
  return text;
}

}  // namespace cslam
