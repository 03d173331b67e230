// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/core.h>

#include <source_location>
#include <stdexcept>
#include <string>
#include <utility>

namespace cslam {

// The user's or the environment's fault: a missing file, a bad option. One line that names the
// thing and the remedy. Caught once, in apps/, and printed without a trace.
class Error : public std::runtime_error {
 public:
  template <typename... Args>
  explicit Error(fmt::format_string<Args...> format, Args&&... args)
      : std::runtime_error(fmt::format(format, std::forward<Args>(args)...)) {}
};

// Our fault: a broken invariant.
class InternalError : public std::logic_error {
 public:
  InternalError(const char* condition, const std::string& message, std::source_location where)
      : std::logic_error(fmt::format("{}:{}: check '{}' failed{}{}", where.file_name(),
                                     where.line(), condition, message.empty() ? "" : ": ",
                                     message)) {}
};

}  // namespace cslam

// CSLAM_CHECK(condition) or CSLAM_CHECK(condition, "format {}", value): throws InternalError.
#define CSLAM_CHECK(condition, ...)                                           \
  do {                                                                        \
    if (!(condition)) [[unlikely]]                                            \
      throw ::cslam::InternalError(#condition, ::fmt::format("" __VA_ARGS__), \
                                   std::source_location::current());          \
  } while (false)
