// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/benchmark/tables.h"

#include <string>
#include <vector>

namespace cslam {

// Drawings of one run, as SVG documents.
struct RunDrawing {
  std::string title;
  std::string top_view;
  std::string trajectory;
};

std::string FormatMarkdown(const BenchmarkResult& result);

// One file with everything in it: no script, nothing fetched.
std::string FormatHtml(const BenchmarkResult& result, const std::vector<RunDrawing>& drawings);

// Every figure of every run, and their medians (docs/formats.md).
std::string FormatJson(const BenchmarkResult& result);

}  // namespace cslam
