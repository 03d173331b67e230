// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/util/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace cslam::test {

// For tests: replaces the first occurrence of what in a good file by something else, and returns
// what read(file) says to it: one line that names the file.
template <typename Read>
std::string ProblemOf(const std::filesystem::path& file, std::string_view what, std::string_view by,
                      Read&& read) {
  std::string text = TestFolder::Read(file);
  const std::size_t start = text.find(what);
  EXPECT_NE(start, std::string::npos) << what << " is not in\n" << text;
  if (start != std::string::npos) text.replace(start, what.size(), by);
  std::ofstream(file, std::ios::binary) << text;
  const std::string message = MessageOf([&] { read(file); });
  EXPECT_THAT(message, testing::HasSubstr(file.filename().string()));
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  return message;
}

}  // namespace cslam::test
