// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cslam/run/run_report.h"

#include <string>

namespace cslam {

// run.json: one JSON object with a final newline; docs/formats.md describes the fields.
std::string FormatRunJson(const RunReport& report);

}  // namespace cslam
