// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/run/process_info.h"

#include <fmt/format.h>

#include <sched.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <ctime>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>

namespace cslam {
namespace {

// What follows "key" and a colon in a file of such lines; empty if there is none.
std::string ValueAfter(const char* path, std::string_view key) {
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line)) {
    if (!line.starts_with(key)) continue;
    const std::size_t begin = line.find_first_not_of(" \t", line.find(':') + 1);
    return begin == std::string::npos ? "" : line.substr(begin);
  }
  return "";
}

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

rusage Usage() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage;
}

// Field 22 of /proc/self/stat. The second field, the program's name, may hold blanks.
std::optional<long> StartTicks() {
  std::ifstream file("/proc/self/stat");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::size_t end_of_name = text.rfind(')');
  if (end_of_name == std::string::npos) return std::nullopt;
  std::istringstream fields(text.substr(end_of_name + 1));
  std::string field;
  for (int i = 3; i < 22; ++i)
    fields >> field;
  long ticks = 0;
  if (!(fields >> ticks)) return std::nullopt;
  return ticks;
}

}  // namespace

double ProcessCpuSeconds() {
  const rusage usage = Usage();
  return Seconds(usage.ru_utime) + Seconds(usage.ru_stime);
}

std::size_t PeakMemoryBytes() {
  // getrusage's maximum starts at that of the parent process, so it comes second.
  constexpr std::size_t kBytesPerKb = 1024;
  std::istringstream text(ValueAfter("/proc/self/status", "VmHWM"));
  std::size_t kilobytes = 0;
  if (text >> kilobytes) return kilobytes * kBytesPerKb;
  return static_cast<std::size_t>(Usage().ru_maxrss) * kBytesPerKb;
}

std::optional<double> ProcessAgeMs() {
  const auto ticks = StartTicks();
  const long ticks_per_s = sysconf(_SC_CLK_TCK);
  timespec now{};
  if (!ticks || ticks_per_s <= 0 || clock_gettime(CLOCK_BOOTTIME, &now) != 0) return std::nullopt;
  const double now_s = static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  const double start_s = static_cast<double>(*ticks) / static_cast<double>(ticks_per_s);
  return 1e3 * (now_s - start_s);
}

std::vector<std::string> CommandLineArguments() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  std::string word;
  std::getline(file, word, '\0');
  while (std::getline(file, word, '\0'))
    words.push_back(word);
  return words;
}

HostInfo DescribeHost() {
  HostInfo host;
  utsname names{};
  if (uname(&names) == 0) {
    host.name = names.nodename;
    host.system = fmt::format("{} {} {}", names.sysname, names.release, names.machine);
  }
  host.cpu = ValueAfter("/proc/cpuinfo", "model name");
  cpu_set_t cpus;
  CPU_ZERO(&cpus);
  if (sched_getaffinity(0, sizeof(cpus), &cpus) == 0) host.num_cpus = CPU_COUNT(&cpus);
  return host;
}

}  // namespace cslam
