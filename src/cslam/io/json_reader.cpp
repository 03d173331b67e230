// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/json_reader.h"

#include "cslam/io/text_lines.h"
#include "cslam/util/check.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace cslam {

using Json = nlohmann::json;

struct JsonDocument {
  std::filesystem::path path;
  Json root;
};

namespace {

const Json& NodeOf(const void* node) {
  return *static_cast<const Json*>(node);
}

// "$.frames[3].box_px" if wanted lies in node, which is called name. Looked for only when something
// is wrong, so that reading a good file keeps no paths.
std::optional<std::string> FindPath(const Json& node, const Json* wanted, const std::string& name) {
  if (&node == wanted) return name;
  if (node.is_array()) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      if (auto path = FindPath(node[i], wanted, fmt::format("{}[{}]", name, i))) return path;
    }
  } else if (node.is_object()) {
    for (const auto& [key, value] : node.items()) {
      if (auto path = FindPath(value, wanted, fmt::format("{}.{}", name, key))) return path;
    }
  }
  return std::nullopt;
}

// What the library says after "[...] parse error at line 3, column 5: ".
std::string Reason(const std::string& what) {
  const std::size_t column = what.find("column ");
  const std::size_t start = what.find(": ", column == std::string::npos ? 0 : column);
  return start == std::string::npos ? what : what.substr(start + 2);
}

Json Parse(const std::filesystem::path& path) {
  const std::string text = ReadBytes(path, "file");
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const std::size_t end = std::min(error.byte, text.size());
    const auto line =
        1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
    throw Error("{}:{}: not JSON: {}", path.string(), line, Excerpt(Reason(error.what())));
  } catch (const Json::exception& error) {  // a number that no double holds
    throw Error("{}: not usable JSON: {}", path.string(), Excerpt(error.what()));
  }
}

}  // namespace

bool JsonValue::IsNull() const {
  return NodeOf(node_).is_null();
}

JsonValue JsonValue::At(std::string_view key) const {
  const Json& node = NodeOf(node_);
  if (!node.is_object()) Fail("expected an object");
  const auto found = node.find(std::string(key));
  if (found == node.end()) Fail(fmt::format("'{}' is missing", key));
  return {*document_, &*found};
}

bool JsonValue::Has(std::string_view key) const {
  return NodeOf(node_).contains(key);
}

void JsonValue::RequireKeys(std::initializer_list<std::string_view> keys,
                            std::initializer_list<std::string_view> optional) const {
  const auto is_in = [](std::initializer_list<std::string_view> list, std::string_view key) {
    return std::find(list.begin(), list.end(), key) != list.end();
  };
  for (const std::string_view key : keys)
    At(key);
  for (const auto& [key, value] : NodeOf(node_).items()) {
    if (!is_in(keys, key) && !is_in(optional, key))
      Fail(fmt::format("unknown key '{}'", Excerpt(key)));
  }
}

std::vector<JsonValue> JsonValue::Items() const {
  const Json& node = NodeOf(node_);
  if (!node.is_array()) Fail("expected an array");
  std::vector<JsonValue> items;
  items.reserve(node.size());
  for (const Json& item : node)
    items.emplace_back(*document_, &item);
  return items;
}

std::vector<JsonValue> JsonValue::Items(std::size_t count) const {
  std::vector<JsonValue> items = Items();
  if (items.size() != count) Fail(fmt::format("expected {} elements, not {}", count, items.size()));
  return items;
}

double JsonValue::Number() const {
  const Json& node = NodeOf(node_);
  if (!node.is_number()) Fail("expected a number");
  const double value = node.get<double>();
  if (!std::isfinite(value)) Fail("expected a finite number");
  return value;
}

double JsonValue::NumberIn(double low, double high) const {
  const double value = Number();
  if (value < low || value > high) Fail(fmt::format("{} is not in {} to {}", value, low, high));
  return value;
}

int JsonValue::IntegerIn(int low, int high) const {
  const double value = Number();
  if (value != std::floor(value)) Fail(fmt::format("{} is not a whole number", value));
  if (value < low || value > high) Fail(fmt::format("{} is not in {} to {}", value, low, high));
  return static_cast<int>(value);
}

std::uint64_t JsonValue::Unsigned64() const {
  const Json& node = NodeOf(node_);
  if (!node.is_number_unsigned()) Fail("expected a whole number from 0 to 2^64 - 1");
  return node.get<std::uint64_t>();
}

bool JsonValue::Bool() const {
  const Json& node = NodeOf(node_);
  if (!node.is_boolean()) Fail("expected true or false");
  return node.get<bool>();
}

std::string JsonValue::Text() const {
  const Json& node = NodeOf(node_);
  if (!node.is_string()) Fail("expected a text");
  return node.get<std::string>();
}

void JsonValue::Fail(std::string_view problem) const {
  const auto* const wanted = static_cast<const Json*>(node_);
  throw Error("{}: {}: {}", document_->path.string(),
              FindPath(document_->root, wanted, "$").value_or("$"), problem);
}

JsonFile::JsonFile(const std::filesystem::path& path)
    : document_(std::make_unique<const JsonDocument>(JsonDocument{path, Parse(path)})) {}

JsonFile::~JsonFile() = default;

JsonValue JsonFile::root() const {
  return {*document_, &document_->root};
}

std::string JsonQuoted(std::string_view text) {
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace cslam
