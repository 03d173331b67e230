// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace cslam {

// Runs a program, found along PATH, with our terminal and waits for its end. Returns its exit
// code; 128 + signal if one ended it. command: its name and arguments. Throws Error if it cannot
// be started.
int RunChildProcess(const std::vector<std::string>& command);

struct ChildOptions {
  std::filesystem::path log;             // gets what it prints; empty: that goes to our terminal
  std::function<bool()> is_interrupted;  // asked now and then; true sends it one SIGTERM
};

// The same for a program that ends by itself soon after a SIGTERM. Ctrl-C does not reach it but
// through is_interrupted, so that it gets one signal, not two.
int RunChildProcess(const std::vector<std::string>& command, const ChildOptions& options);

}  // namespace cslam
