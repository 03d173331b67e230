// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace cslam {

std::string_view Version();    // "0.1.0"
std::string_view GitCommit();  // abbreviated, "-dirty" with local changes; "unknown" without git

}  // namespace cslam
