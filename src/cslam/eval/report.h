// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/eval/ate.h"
#include "cslam/eval/rpe.h"

#include <optional>
#include <string>
#include <string_view>

namespace cslam {

// Which number a bar is set for.
enum class Statistic { kRmse, kMean, kMedian, kMax };

double ValueOf(const ErrorStatistics& statistics, Statistic statistic);

// "rmse", "mean", "median" or "max"; anything else gives nullopt.
std::optional<Statistic> ParseStatistic(std::string_view name);
std::string NameOf(Statistic statistic);

// Where the trajectories came from, as the report shall name them.
struct ReportNames {
  std::string reference;
  std::string estimate;
};

// What was done, what was matched and the statistics, lined up for a terminal.
std::string FormatReport(const AteResult& result, const ReportNames& names);
std::string FormatReport(const RpeResult& result, const ReportNames& names);

// The same as one JSON object, indented, with a final newline; units are in the keys and every
// single error is listed with its stamp. docs/evaluation.md describes the fields.
std::string FormatJson(const AteResult& result, const ReportNames& names);
std::string FormatJson(const RpeResult& result, const ReportNames& names);

// One line: what was done, as in "ATE, SE(3) Umeyama alignment without scale, nearest stamp
// within 0.02 s".
std::string Headline(const AteResult& result);
std::string Headline(const RpeResult& result);

}  // namespace cslam
