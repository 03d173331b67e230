// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace cslam {

enum class TextAlign { kLeft, kRight };

struct TextColumn {
  std::string title;
  TextAlign align = TextAlign::kLeft;
};

// Rows of text lined up in columns, for terminals and logs. Widths count UTF-8 code points.
//
//   TextTable table({{"stage"}, {"median [ms]", TextAlign::kRight}});
//   table.AddRow({"tracking", "7.31"});
//   fmt::print("{}", table.Text());
class TextTable {
 public:
  // Two left-aligned columns without titles: names and values.
  TextTable();

  // The title line, and the rule below it, are left out when every title is empty.
  explicit TextTable(std::vector<TextColumn> columns);

  // Fewer cells than columns are completed with empty ones; more are a bug.
  void AddRow(std::vector<std::string> cells);

  // A horizontal line between the rows before and after.
  void AddRule();

  // Every line ends with a newline and has no trailing blanks; indent: blanks before each line.
  std::string Text(int indent = 0) const;

 private:
  std::vector<TextColumn> columns_;
  std::vector<std::vector<std::string>> rows_;  // an empty row is a rule
};

}  // namespace cslam
