// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Stands in for <source_location>, which libstdc++ 12 withholds from clang 14. For tools/tidy.sh
// only; the compiler that builds the program never sees it.
#pragma once

#include <source_location>

#if defined(__clang__) && !defined(__cpp_lib_source_location)
namespace std {
struct source_location {
  static constexpr source_location current() { return {}; }
  constexpr const char* file_name() const { return ""; }
  constexpr unsigned line() const { return 0; }
};
}  // namespace std
#endif
