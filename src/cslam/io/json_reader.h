// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cslam {

struct JsonDocument;

// A value in a JsonFile, which must outlive it. Every function throws Error with the file and the
// value's place in it ("objects.json: $.objects[3].box.size_m: ...") unless the value is as asked.
class JsonValue {
 public:
  JsonValue(const JsonDocument& document, const void* node) : document_(&document), node_(node) {}

  bool IsNull() const;

  // The object's value of that key, which must be there.
  JsonValue At(std::string_view key) const;
  bool Has(std::string_view key) const;  // false too for what is no object
  // The value is an object with these keys, perhaps the optional ones, and no others.
  void RequireKeys(std::initializer_list<std::string_view> keys,
                   std::initializer_list<std::string_view> optional = {}) const;
  // The elements of an array.
  std::vector<JsonValue> Items() const;
  std::vector<JsonValue> Items(std::size_t count) const;  // exactly so many

  double Number() const;  // finite
  double NumberIn(double low, double high) const;
  int IntegerIn(int low, int high) const;
  std::uint64_t Unsigned64() const;  // exact, which a double is not
  bool Bool() const;
  std::string Text() const;

  [[noreturn]] void Fail(std::string_view problem) const;

 private:
  const JsonDocument* document_;
  const void* node_;
};

// A JSON text in memory. Heavy JSON headers stay in the .cpp file.
class JsonFile {
 public:
  // Throws Error with file:line if it cannot be read or is not JSON.
  explicit JsonFile(const std::filesystem::path& path);
  ~JsonFile();
  JsonFile(const JsonFile&) = delete;
  JsonFile& operator=(const JsonFile&) = delete;

  JsonValue root() const;

 private:
  std::unique_ptr<const JsonDocument> document_;
};

// text as a JSON string, with quotes; bytes that are not UTF-8 become U+FFFD.
std::string JsonQuoted(std::string_view text);

}  // namespace cslam
