// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace cslam {

// One line of a text table: its fields, which blanks separate, and where it stands.
struct TextLine {
  int number = 0;  // from 1, as editors count
  std::vector<std::string> fields;
};

// The lines that say something: empty ones and those that start with '#' are left out. CR LF line
// ends and a UTF-8 byte order mark are fine. Throws Error with path and reason if unreadable.
std::vector<TextLine> ReadTextLines(const std::filesystem::path& path);

// The same from text.
std::vector<TextLine> SplitTextLines(std::string_view text);

// The bytes of a file. what stands for it in errors: "cannot read <what> '<path>': <reason>".
std::string ReadBytes(const std::filesystem::path& path, std::string_view what);

// Text of a file as an error message may show it: short and printable.
std::string Excerpt(std::string_view text);

}  // namespace cslam
