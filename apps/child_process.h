// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace cslam {

// Runs a program, found along PATH, with our terminal and waits for its end. Returns its exit
// code; 128 + signal if one ended it. command: its name and arguments. Throws Error if it cannot
// be started.
int RunChildProcess(const std::vector<std::string>& command);

}  // namespace cslam
