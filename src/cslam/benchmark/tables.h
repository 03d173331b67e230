// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/benchmark/summary.h"

#include <string>
#include <vector>

namespace cslam {

// A table of a report, whatever it is written in. The first column is text, the others figures.
struct ReportTable {
  std::string title;
  std::string note;  // one sentence; may be empty
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

// Everything the report shows in figures: errors with the layer on and off and beside others,
// objects and changes, maps and loops, times. A cell is the median, with the least and the most
// where there are several runs.
std::vector<ReportTable> MakeTables(const BenchmarkResult& result);

// "15.2 (14.0 to 16.1)"; "-" for nothing.
std::string CellText(const std::optional<Spread>& spread, const FigureInfo& figure);

}  // namespace cslam
