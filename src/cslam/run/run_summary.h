// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/run/run_report.h"

#include <string>

namespace cslam {

// The result of a run as two tables for a terminal: what came out, and the times of the stages.
std::string FormatRunSummary(const RunReport& report);

}  // namespace cslam
