// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/util/text_table.h"

#include "cslam/util/check.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

namespace cslam {
namespace {

constexpr std::size_t kGap = 2;  // blanks between columns

std::size_t DisplayWidth(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;  // not a UTF-8 continuation byte
  }));
}

std::string Line(const std::vector<std::string>& cells, const std::vector<TextColumn>& columns,
                 const std::vector<std::size_t>& widths) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) line.append(kGap, ' ');
    const std::size_t padding = widths[i] - DisplayWidth(cells[i]);
    if (columns[i].align == TextAlign::kRight) line.append(padding, ' ');
    line += cells[i];
    if (columns[i].align == TextAlign::kLeft) line.append(padding, ' ');
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

}  // namespace

TextTable::TextTable() : TextTable({TextColumn{}, TextColumn{}}) {}

TextTable::TextTable(std::vector<TextColumn> columns) : columns_(std::move(columns)) {
  CSLAM_CHECK(!columns_.empty());
}

void TextTable::AddRow(std::vector<std::string> cells) {
  CSLAM_CHECK(cells.size() <= columns_.size(), "{} cells in {} columns", cells.size(),
              columns_.size());
  cells.resize(columns_.size());
  rows_.push_back(std::move(cells));
}

void TextTable::AddRule() {
  rows_.emplace_back();
}

std::string TextTable::Text(int indent) const {
  CSLAM_CHECK(indent >= 0);
  std::vector<std::string> titles;
  std::vector<std::size_t> widths;
  for (const TextColumn& column : columns_) {
    titles.push_back(column.title);
    widths.push_back(DisplayWidth(column.title));
  }
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], DisplayWidth(row[i]));
  }
  std::size_t total = kGap * (columns_.size() - 1);
  for (const std::size_t width : widths)
    total += width;

  const std::string margin(static_cast<std::size_t>(indent), ' ');
  const std::string rule(total, '-');
  std::string text;
  const auto append = [&](const std::string& line) {
    text += (line.empty() ? line : margin + line) + '\n';
  };
  if (std::any_of(titles.begin(), titles.end(), [](const auto& t) { return !t.empty(); })) {
    append(Line(titles, columns_, widths));
    append(rule);
  }
  for (const auto& row : rows_)
    append(row.empty() ? rule : Line(row, columns_, widths));
  return text;
}

}  // namespace cslam
