// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace cslam {

struct CommandResult {
  int exit_code = 0;   // 127: there is no such program
  std::string output;  // what it said on both channels
};

// Runs a program (found in PATH, without a shell) in a folder until it ends. on_wait is called a
// few times a second. Its messages are in English; it gets no input. Throws Error only if no
// process can be made at all. If on_wait throws, the program is ended first.
CommandResult RunCommand(const std::vector<std::string>& arguments,
                         const std::filesystem::path& folder,
                         const std::function<void()>& on_wait = {});

}  // namespace cslam
