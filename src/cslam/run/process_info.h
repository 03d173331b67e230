// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace cslam {

// CPU time of all threads of this process so far, user and system, in seconds.
double ProcessCpuSeconds();

// The most memory this process has ever held (resident set), in bytes.
std::size_t PeakMemoryBytes();

// Wall-clock time since this process was started, in ms, to about 10 ms (the kernel's clock tick);
// nullopt where the system does not tell.
std::optional<double> ProcessAgeMs();

// The words of the command line after the name of the program.
std::vector<std::string> CommandLineArguments();

// The machine, for reports.
struct HostInfo {
  std::string name;
  std::string system;  // "Linux 6.1.0 x86_64"
  std::string cpu;     // model name; empty if the system does not tell
  int num_cpus = 0;    // that this process may use
};
HostInfo DescribeHost();

}  // namespace cslam
