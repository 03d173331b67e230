// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/util/check.h"

#include <bit>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace cslam {

static_assert(std::endian::native == std::endian::little, "numbers are stored as they lie");

// Packs numbers one after the other, little-endian, without gaps.
class ByteWriter {
 public:
  explicit ByteWriter(std::size_t num_bytes) { bytes_.reserve(num_bytes); }

  template <typename T>
  void Add(T value) {
    static_assert(std::is_arithmetic_v<T>);
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes_.append(raw, sizeof(T));
  }

  std::string Take() && { return std::move(bytes_); }

 private:
  std::string bytes_;
};

// Unpacks them again. Whoever reads beyond the end gets an Error.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <typename T>
  T Next() {
    static_assert(std::is_arithmetic_v<T>);
    if (rest_.size() < sizeof(T)) throw Error("a blob is too short");
    T value;
    std::memcpy(&value, rest_.data(), sizeof(T));
    rest_.remove_prefix(sizeof(T));
    return value;
  }

 private:
  std::string_view rest_;
};

}  // namespace cslam
