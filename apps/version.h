// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace cslam {

std::string_view Version();    // "0.1.0"
std::string_view GitCommit();  // abbreviated, "-dirty" with local changes; "unknown" without git
std::string ProgramName();     // "changing-slam 0.1.0 (abbreviated commit)", for what it writes

}  // namespace cslam
